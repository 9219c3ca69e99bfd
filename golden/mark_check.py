"""Checks mark.py by answers that are right, missing, wrong in a known way, or a number where a refusal is right: `python3 golden/mark_check.py`."""
import copy
import json
import re

from mark import HERE, explained_in, mark

VECTORS = json.loads((HERE / "vectors.json").read_text())["vectors"]
WRONG = json.loads((HERE / "wrong_answers.json").read_text())
RIGHT = {vector["name"]: vector.get("answer") or {"refused": vector["refused"]} for vector in VECTORS}


def marked(answers):
    return mark(VECTORS, WRONG, answers)


def changed(name, **keys):
    return marked({name: copy.deepcopy(RIGHT[name]) | keys})[0]


assert marked(RIGHT) == ([], len(VECTORS), 0)
# Missing is not wrong.
lines, right, missing = marked({})
assert not lines and not right and missing > len(VECTORS)
assert marked({"sorting and error sum": {"sign": RIGHT["sorting and error sum"]["sign"]}})[:2] == ([], 1)
# Six answered vectors get six lines at most, whatever is wrong with them.
spoiled = {name: {key: [7.0] for key in answer} for name, answer in list(RIGHT.items())[:6]}
assert len(marked(spoiled)[0]) == 6
for words in ("seven", None, [None], {"a": 1}):
    assert changed("sorting and error sum", frequency_error=words) == ["sorting and error sum, (4), (5), (6): frequency_error is not the known answer"], words
# A number where a refusal is right is named so, and so is another kind.
for vector in VECTORS:
    if "refused" in vector:
        name, kind = vector["name"], vector["refused"]
        [line] = marked({name: {"roots": [1.0]}})[0]
        assert line.endswith(f": roots: a number where a refusal is right ({kind})"), line
        [line] = marked({name: {"refused": "of another kind"}})[0]
        assert line.endswith(f": refused as of another kind, where it is {kind}"), line
    else:
        [line] = marked({vector["name"]: {"refused": "close modes"}})[0]
        assert line.endswith(": refused as close modes, and has an answer"), line
# Each mistake is named by its own answer: in an equation, and in a sentence.
sentences = [mistake | dict(vector=vector["name"]) for vector in VECTORS for mistake in vector.get("mistakes", [])]
for mistake in WRONG + sentences:
    [line] = marked({mistake["vector"]: {mistake["key"]: mistake["answer"]}})[0]
    assert mistake["what"] in line, (mistake["what"], line)
# Each chapter of the tour ends in the vectors that mark it.
for chapter in [*range(1, 11), 12]:
    [path] = (HERE.parent / "paper" / "tour").glob(f"{chapter:02}_*.md")
    end = " ".join(path.read_text().rsplit("</details>", 1)[1].split())
    named = {name for name in re.findall(r"\*([^*]+)\*", end)}
    named |= {f"structure {number}" for number in range(1, 51)} if "structure 50" in named else set()
    assert named == {vector["name"] for vector in VECTORS if chapter in explained_in(vector)} and f"--chapter {chapter} " in end, chapter
print(f"mark.py names {len(WRONG + sentences)} wrong answers, and refusals of {len({v['refused'] for v in VECTORS if 'refused' in v})} kinds")
