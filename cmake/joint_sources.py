"""Which sources may be compiled together, as one file that includes them: most of the time of one goes into headers of
others. Files that define one name, each for itself, share no group.
Use: joint_sources.py FILE...; prints "GROUP FILE", a line for each. Or import groups().
SPDX-License-Identifier: Apache-2.0
"""
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


def groups(files):
    """Lists of files, MOST at most, of which none defines a name of another. In the order of their names."""
    packed = []
    for file in sorted(files):
        text = pathlib.Path(file).read_text()
        own = set(DEFINITION.findall(text)) | set(ALIAS.findall(text))
        all_names = own | set(LOCAL_CONSTANT.findall(text))
        for together, taken_own, taken in packed:
            if len(together) < MOST and not own & taken and not all_names & taken_own:
                together.append(file)
                taken_own |= own
                taken |= all_names
                break
        else:
            packed.append(([file], own, all_names))
    return [together for together, _, _ in packed]


if __name__ == "__main__":
    for number, together in enumerate(groups(sys.argv[1:])):
        for file in together:
            print(number, file)
