"""Which sources may be compiled together, as one file that includes them: most of the time of one goes into headers of
others. Files that define one name, each for itself, share no group; nor does a file with one that defines a type of its
own which a header of the file's defines too.
Use: joint_sources.py FILE...; prints "GROUP FILE", a line for each. Or import groups().
SPDX-License-Identifier: Apache-2.0
"""
import functools
import pathlib
import re
import sys

MOST = 16  # files of a group: with more the last group would be compiled alone for long
# A definition: its name stands before a parenthesis, brace, bracket or equals sign. At the start of a line it is the
# file's, a constant with spaces before it is a function's.
DEFINITION = re.compile(r"^(?!namespace|using|return|TEST|template|INSTANTIATE)[A-Za-z_][\w:<>,&*\[\] ]*?[ &*](\w+)"
                        r"(?:\(| \{| : |\[\w*\] =| =|\{)", re.MULTILINE)
ALIAS = re.compile(r"^using (\w+) =", re.MULTILINE)
LOCAL_CONSTANT = re.compile(r"^ +(?:static )?constexpr [\w:<>, ]+? (\w+)(?:\[\w*\])? =", re.MULTILINE)
TYPE = re.compile(r"^(?:struct|class|enum(?: class)?|union) (\w+)(?: final)?(?: :[^{;]*)? ?\{", re.MULTILINE)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = [ROOT / folder for folder in ("", "app", "lib/include", "lib/src", "oracle/include", "oracle", "tests")]


@functools.lru_cache(maxsize=None)
def included(file):
    """The project's headers that a file includes itself."""
    paths = [next((folder / name for folder in (file.parent, *FOLDERS) if (folder / name).is_file()), None)
             for name in INCLUDE.findall(file.read_text())]
    return [path.resolve() for path in paths if path is not None]


def types_of_headers(file):
    """The names of types that come with a file's headers, and with theirs."""
    names, seen, left = set(), set(), [file.resolve()]
    while left:
        for header in included(left.pop()):
            if header not in seen:
                seen.add(header)
                left.append(header)
                names |= types_in(header)
    return names


@functools.lru_cache(maxsize=None)
def types_in(file):
    return frozenset(TYPE.findall(file.read_text()))


def groups(files):
    """Lists of files, MOST at most, of which none defines a name of another. In the order of their names."""
    packed = []
    for file in sorted(files):
        path = pathlib.Path(file)
        text = path.read_text()
        own = set(DEFINITION.findall(text)) | set(ALIAS.findall(text))
        all_names = own | set(LOCAL_CONSTANT.findall(text))
        types, of_headers = set(TYPE.findall(text)), types_of_headers(path)
        for together, taken_own, taken, taken_types, taken_of_headers in packed:
            clashes = (own & taken or all_names & taken_own or types & taken_of_headers or of_headers & taken_types)
            if len(together) < MOST and not clashes:
                together.append(file)
                taken_own |= own
                taken |= all_names
                taken_types |= types
                taken_of_headers |= of_headers
                break
        else:
            packed.append(([file], own, all_names, types, of_headers))
    return [together for together, *_ in packed]


if __name__ == "__main__":
    for number, together in enumerate(groups(sys.argv[1:])):
        for file in together:
            print(number, file)
