"""Parts of pages that tools write, each between two lines: <!-- NAME: begin; written by tools/TOOL --> and
<!-- NAME: end -->. And what such tools have in common: arguments, what `lamp` prints, errors.
For import by the tools; by itself it does nothing.
SPDX-License-Identifier: Apache-2.0
"""
import argparse
import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOOL = pathlib.Path(sys.argv[0]).name


def fail(text, code=2):
    print(f"tools/{TOOL}: {text}", file=sys.stderr)
    sys.exit(code)


def arguments(about, **option):
    """`lamp`, and what the tool's one option says: [--OPTION ...] [LAMP]."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, kind in option.items():
        parser.add_argument(f"--{name}", **kind)
    parser.add_argument("lamp", nargs="?", default=str(ROOT / "build/release/app/lamp"))
    return parser.parse_args()


CHECK = {"check": {"action": "store_true"}}


def lamp_json(lamp, *words):
    """What `lamp WORDS --json` prints, parsed."""
    try:
        done = subprocess.run([lamp, *words, "--json"], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        fail(f"{error}: {getattr(error, 'stderr', '') or ''}".rstrip(": \n"))
    return json.loads(done.stdout)


def results_of(name, suites):
    """A results.json of `lamp bench`, of one of these suites."""
    try:
        data = json.loads(pathlib.Path(name).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        fail(f"{name}: {error}")
    if not isinstance(data, dict) or data.get("format") != "lamplight-results":
        fail(f"{name}: is no results file; expected a results.json of lamp bench")
    suite = data["suite"]["name"]
    if suite not in suites:
        fail(f"{name}: holds the suite {suite}; expected one of {', '.join(suites)}")
    return data


def bench_results(suite):
    """Of a tool whose one argument is the results.json of this suite: the results, after the line that says whose."""
    if len(sys.argv) != 2:
        fail(f"expected one file, the results.json of `lamp bench {suite}`")
    data = results_of(sys.argv[1], [suite])
    run = data["run"]
    print(f"{run['device']}, driver {run['driver']}, commit {run['commit']}\n")
    return data["results"]


def milliseconds(result, part):
    """The median of a part's times: cull, shade, cull+shade or frame; "-" where there are none."""
    return f"{result['times'][part]['median']:.3f}" if result["times"] else "-"


def print_table(head, rows, texts=None):
    """Columns from `texts` on are numbers, on the right; none: all are texts."""
    texts = len(head) if texts is None else texts
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * texts + "--:|" * (len(head) - texts))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def around(page, text, name):
    """A page's text up to a part, the part, and the text behind it."""
    begin, end = f"<!-- {name}: begin; written by tools/{TOOL} -->\n", f"<!-- {name}: end -->\n"
    if text.count(begin) != 1 or text.count(end) != 1 or text.index(begin) > text.index(end):
        fail(f"{page.name}: expected the lines\n{begin}{end}once each, in this order")
    first, last = text.index(begin) + len(begin), text.index(end)
    return text[:first], text[first:last], text[last:]


def write_parts(page, parts, check=False):
    """Puts each part in its place, by name. With `check` changes nothing, and fails where one is not what stands there."""
    old = new = page.read_text()
    for name, part in parts.items():
        before, _, behind = around(page, new, name)
        new = f"{before}\n{part}\n{behind}"
    if check and new != old:
        fail(f"{page.name}: is not up to date; run tools/{TOOL}", 1)
    if not check:
        page.write_text(new)
