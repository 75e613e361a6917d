#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""Every link of a site's pages leads to a file of the site, and to a place that is in it.

check_links.py SITE
"""

import functools
import html.parser
import pathlib
import sys
import urllib.parse


# Doxygen links to a section of private classes, which it leaves out.
LEFT_OUT = {'nested-classes'}


class Page(html.parser.HTMLParser):
    """What a page links to, and the places in it that can be linked to."""

    def __init__(self, file):
        super().__init__()
        self.links = []
        self.places = set()
        self.feed(file.read_text(encoding='utf-8', errors='replace'))

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        for key in ('href', 'src'):
            if named.get(key):
                self.links.append(named[key])
        for key in ('id', 'name'):
            if named.get(key):
                self.places.add(named[key])


@functools.lru_cache(maxsize=None)
def read(file):
    return Page(file)


def broken(site):
    for file in sorted(site.rglob('*.html')):
        for link in read(file).links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            place = urllib.parse.unquote(parts.path)
            target = file if not place else (site / place[1:] if place.startswith('/') else file.parent / place).resolve()
            if target.is_dir():
                target = target / 'index.html'
            if not target.is_file():
                yield file, link
            elif parts.fragment and target.suffix == '.html' and parts.fragment not in LEFT_OUT:
                if urllib.parse.unquote(parts.fragment) not in read(target).places:
                    yield file, link


def main():
    site = pathlib.Path(sys.argv[1]).resolve()
    found = sorted({(str(file.relative_to(site)), link) for file, link in broken(site)})
    for file, link in found:
        print('%s: %s leads nowhere' % (file, link))
    pages = sum(1 for _ in site.rglob('*.html'))
    print('%d pages, %d broken links' % (pages, len(found)))
    sys.exit(1 if found or pages == 0 else 0)


if __name__ == '__main__':
    main()
