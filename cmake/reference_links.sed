# SPDX-License-Identifier: Zlib
# For Doxygen: links of a page to other pages and to the web stay, those to files and to its own headings become text.
s/\]\(([^):]*\.md)/](page:\1/g
s/(^|[^!])\[([^][]*)\]\([^):]*\)/\1\2/g
s/\]\(page:/](/g
