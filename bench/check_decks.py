#!/usr/bin/env python3
"""What `plash check` makes of every deck in a folder of decks from elsewhere, written to docs/results/decks.md.

    python3 bench/check_decks.py [folder, default ../shared/decks]

The folder holds an INDEX.md whose rows count nodes and elements of each deck; these counts were taken by another
program. A deck that Plash reads without an error of its own, and with these counts, is fine; all others are
listed with the reason.
"""
import collections
import datetime
import json
import os
import re
import subprocess
import sys

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PLASH = os.environ.get("PLASH", os.path.join(TOP, "build/release/plash"))
PAGE = os.path.join(TOP, "docs/results/decks.md")
SLOWEST = 60  # seconds that one deck may take

# Physics that Plash does not aim at: these keywords need not reach the Model.
ELSEWHERE = re.compile(r"IMPLICIT|THERMAL|^EM_|^ICFD|CESE|^BATTERY|USER_DEFINED|USER_SUBROUTINE|BOUNDARY_HEAT|"
                       r"BOUNDARY_RADIATION|BOUNDARY_CONVECTION|BOUNDARY_FLUX|TEMPERATURE|FREQUENCY|EIGENVALUE|^MESH_")

# Messages about physics that is not there, in decks that are not to blame.
NOT_BROKEN = re.compile(r"^read, but this physics is not run yet|^unknown keyword|is not supported|are not supported|"
                        r"not supported for")

# Counts that differ from the index, and why.
DIFFERENCES = {
    "EXP_SC_JOINT_SCREW.key": "the index takes two lines for a solid; the deck has one line for each",
    "WillemJR+dynakw/test/full_files/sample.k": "nodes 1 and 2 stand twice in the deck",
    "test_node_param.k": "the node has a coordinate that names no parameter",
    "test_param_format_error.k": "the node has a coordinate that names no parameter",
    "umat41/eccentric/eccentric": "a node has a coordinate that names no parameter",
    "musical-dollop/TMP/keyfile.key": "the index counts the second line of a *ELEMENT_BEAM_SCALAR as a beam",
    "vivaplus-50F-pedestrian_TB024.key": "the index takes files of other folders for the missing includes",
    "PIPER_run_vivaplus.key": "the index takes files of other folders for the missing includes",
    "mlp6+fem/examples/": "the index takes files of other folders for the missing includes",
    "batmac_cylinder/main.k": "the index takes files of other folders for the missing includes",
}


def index_of(folder):
    """Rows of INDEX.md: deck, complete, and the counts of nodes, shells, solids, beams and particles."""
    with open(os.path.join(folder, "INDEX.md"), encoding="utf-8") as file:
        for line in file:
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if len(cells) >= 8 and re.match(r"(targets|corpus)/", cells[0]):
                yield cells[0], cells[1] == "1", [int(cell) for cell in cells[3:8]]


def check(path):
    """The report as JSON, or the reason why there is none."""
    try:
        done = subprocess.run([PLASH, "check", "--json", path], capture_output=True, timeout=SLOWEST)
        return json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        return f"no answer within {SLOWEST} s"
    except ValueError:
        return f"ended with {done.returncode}: {done.stderr.decode(errors='replace')[:200]}"


def reasons(report):
    """What is wrong with a deck: messages of one kind together, each kind once."""
    kinds = collections.OrderedDict()
    for message in report["errors"]:
        text = message["message"]
        if NOT_BROKEN.search(text):
            continue
        key = (message["keyword"], message["field"])
        more = re.match(r"\.\.\. and (\d+) more", text)
        first, count = kinds.get(key, (text, 0))
        kinds[key] = (first, count + (int(more.group(1)) if more else 1))
    return [f"*{keyword}{' ' + field if field else ''}: {text}" + (f" ({count} times)" if count > 1 else "")
            if keyword else text for (keyword, field), (text, count) in kinds.items()]


def difference_of(deck, wanted, report):
    elements = report["elements"]
    found = [report["nodes"], elements["shell"], elements["solid"], elements["beam"], elements["sph"]]
    if found == wanted:
        return None
    why = [text for part, text in DIFFERENCES.items() if part in deck]
    return f"{found} for {wanted}: {why[0] if why else 'NOT EXPLAINED'}"


def escaped(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(TOP, "..", "shared", "decks")
    rows, failed, broken, fragments, differences = [], [], [], [], []
    blocks, unknown, clean, equal = collections.Counter(), collections.Counter(), 0, 0
    for deck, complete, wanted in index_of(folder):
        report = check(os.path.join(folder, deck))
        if isinstance(report, str):
            failed.append((deck, report))
            continue
        for keyword in report["keywords"]:
            if ELSEWHERE.search(keyword["name"]):
                blocks["elsewhere"] += keyword["blocks"]
                continue
            blocks[keyword["status"]] += keyword["blocks"]
            if keyword["status"] == "unknown":
                unknown[keyword["name"]] += keyword["blocks"]
        difference = difference_of(deck, wanted, report)
        if difference:
            differences.append((deck, difference))
        else:
            equal += 1
        wrong = reasons(report)
        clean += not wrong
        if wrong:
            (broken if complete else fragments).append((deck, wrong))
        fields = report["fields"]
        rows.append((deck, f"{report['bytes'] / 1e6:.2f}", report["nodes"], sum(report["elements"].values()),
                     sum(keyword["blocks"] for keyword in report["keywords"]), fields["honoured"],
                     fields["ignored"], fields["unsupported"], f"{report['seconds']:.3f}"))
    reached = blocks["run"] + blocks["read"] + blocks["ignored"]
    total = reached + blocks["unknown"]
    with open(PAGE, "w", encoding="utf-8") as page:
        page.write(f"""# Real decks

What `plash check` makes of {len(rows) + len(failed)} decks that nobody of this project wrote; they are not part of
it. Written by `python3 bench/check_decks.py` on {datetime.date.today()}.

- {len(failed)} decks give no report. {clean} have no error of their own; {len(broken)} that look complete and
  {len(fragments)} fragments (meshes, control cards or includes alone) are broken, for the reasons below.
- Counts of nodes, shells, solids, beams and particles equal those of the index for {equal} decks; the
  {len(differences)} others are explained below.
- {100 * reached / total:.2f} % of the {total} keyword blocks reach the Model ({blocks['run']} run, {blocks['read']}
  read only, {blocks['ignored']} harmless; implicit, thermal, electromagnetic, ICFD/CESE, frequency and user-defined
  keywords, {blocks['elsewhere']} blocks, aside). Not known: {', '.join(f'{name} ({count})' for name, count in
                                                                       unknown.most_common()) or 'none'}.

A deck is fine here when its text is right; whether Plash has the physics to run it is another matter, told by
the columns: *honoured*, *ignored* and *unsupported* count the fields that a deck sets.

| deck | MB | nodes | elements | keywords | honoured | ignored | unsupported | seconds |
|---|---|---|---|---|---|---|---|---|
""")
        for row in rows:
            page.write("| " + " | ".join(str(cell) for cell in row) + " |\n")
        for title, items in (("Decks without a report", failed), ("Counts that differ from the index", differences)):
            page.write(f"\n## {title}\n" + ("" if items else "None.\n"))
            for deck, text in items:
                page.write(f"- {deck}: {escaped(text)}\n")
        for title, items in (("Complete decks that are broken", broken), ("Fragments, and what they lack", fragments)):
            page.write(f"\n## {title}\n")
            for deck, texts in items:
                more = f"; {len(texts) - 4} more kinds" if len(texts) > 4 else ""
                text = "; ".join(texts[:4]) + more
                page.write(f"- {deck}: {escaped(text.replace(os.path.abspath(folder) + '/', ''))}\n")
    print(f"{len(rows)} decks, {clean} without error, {100 * reached / total:.2f} % of the blocks reach the Model, "
          f"{len(failed)} failed, {sum('NOT EXPLAINED' in text for _, text in differences)} unexplained counts")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
