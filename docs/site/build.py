#!/usr/bin/env python3
# SPDX-License-Identifier: Zlib
"""Builds the site: README, docs and what they link to, by mkdocs; the reference and the page to try it on beside them.

build.py WORK SITE API PAGE: WORK is for what is made on the way, API what Doxygen wrote, PAGE the page to try.
"""

import pathlib
import re
import shutil
import subprocess
import sys

TREE = pathlib.Path(__file__).resolve().parent.parent.parent
PAGES = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'packaging/README.md']
LINK = re.compile(r'(?<=\]\()([^)\s]+)(?=\))')
FRAME = '<iframe src="../try/index.html" title="{0}" style="width: 100%; height: 80vh; border: 0"></iframe>\n'


def staged_name(path):
    """Where a page of the tree stands in the site."""
    return 'index.md' if path == 'README.md' else path


class Stage:
    """The pages as mkdocs takes them. Files that they link to and that are no pages become pages that show them."""

    def __init__(self, folder):
        self.folder = folder
        self.shown = set()

    def write(self, name, text):
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding='utf-8')

    def add_page(self, path):
        text = (TREE / path).read_text(encoding='utf-8')
        here = pathlib.PurePosixPath(path).parent
        self.write(staged_name(path), LINK.sub(lambda link: self.target(link[0], here), text))

    def target(self, link, here):
        """What a link of a page in the folder `here` becomes; what is no file of the tree stays."""
        place, hash_mark, heading = link.partition('#')
        if not place or ':' in place:
            return link
        file = (TREE / here / place).resolve()
        if not file.exists() or TREE not in file.parents:
            return link
        path = file.relative_to(TREE).as_posix()
        if file.is_dir():
            name = self.show_folder(path)
        elif file.suffix == '.md':
            name = staged_name(path)
        elif path.startswith('docs/'):
            return link
        else:
            name = self.show_file(path)
        up = '../' * len(here.parts)
        return up + name + hash_mark + heading

    def show_file(self, path):
        name = path + '.md'
        if name not in self.shown:
            self.shown.add(name)
            try:
                text = (TREE / path).read_text(encoding='utf-8')
            except UnicodeDecodeError:
                text = '(%d bytes)' % (TREE / path).stat().st_size
            indented = ''.join('    ' + line + '\n' for line in text.splitlines())
            self.write(name, '# %s\n\n%s' % (path, indented))
        return name

    def show_folder(self, path):
        name = path + '/index.md'
        if name not in self.shown:
            self.shown.add(name)
            listed = ''
            for file in sorted((TREE / path).iterdir()):
                inside = file.relative_to(TREE).as_posix()
                if file.is_file() and file.suffix == '.md':
                    self.add_page(inside)
                    listed += '- [%s](%s)\n' % (file.name, file.name)
                elif file.is_file() and file.stat().st_size < 200000:
                    self.show_file(inside)
                    listed += '- [%s](%s.md)\n' % (file.name, file.name)
                else:
                    listed += '- %s\n' % file.name
            self.write(name, '# %s\n\n%s' % (path, listed))
        return name


def stage_all(folder):
    stage = Stage(folder)
    for file in sorted((TREE / 'docs').rglob('*')):
        path = file.relative_to(TREE).as_posix()
        if file.is_dir() or path.startswith('docs/site/'):
            continue
        if file.suffix == '.md':
            stage.add_page(path)
        else:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, folder / path)
    for path in PAGES:
        stage.add_page(path)
    stage.write('LICENSE.md', '# LICENSE\n\n' + (TREE / 'LICENSE').read_text(encoding='utf-8'))
    stage.write('try.md', '# Try it\n\n[In a window of its own](try/index.html)\n\n'
                + FRAME.format('A wet cloth to play with').replace('../', ''))
    stage.write('reference.md', '# Reference of the library\n\n[All that is public](api/index.html), with a search of its own.\n')


def main():
    work, site, api, page = (pathlib.Path(argument).resolve() for argument in sys.argv[1:5])
    shutil.rmtree(work, ignore_errors=True)
    shutil.rmtree(site, ignore_errors=True)
    pages = work / 'pages'
    stage_all(pages)
    for folder, name in ((api, 'api'), (page, 'try')):
        shutil.copytree(folder, pages / name)
    configuration = (TREE / 'docs' / 'site' / 'mkdocs.yml').read_text(encoding='utf-8')
    (work / 'mkdocs.yml').write_text('docs_dir: pages\nsite_dir: %s\n%s' % (site, configuration), encoding='utf-8')
    subprocess.run(['mkdocs', 'build', '--quiet', '-f', str(work / 'mkdocs.yml')], check=True)


if __name__ == '__main__':
    main()
