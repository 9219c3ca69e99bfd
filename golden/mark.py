"""Marks an implementation of the method, in whatever language, by the known answers of vectors.json.

    python3 golden/mark.py answers.json
    python3 golden/mark.py --chapter 3 answers.json      the vectors of one chapter of the tour alone

answers.json has an object under each vector's name, such as {"sorting and error sum": {"frequency_error": 0.1, ...}, ...}, with the keys
and the shapes of its `answer` for its `input`: vectors.md says what each key is. A number may be off by `tolerance` times the largest of
its answer. A vector with `refused` has no answer: {"refused": "close modes"} is right, the kinds stand in vectors.md.

Each wrong vector is one line, which names the mistake where the answer is that of a known one (wrong_answers.json, and `mistakes` of the
vector). What is not answered is not wrong: it is counted below. The exit status is 1 if something is wrong.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
NAMED = 1e-5  # six digits of a wrong answer are stored


def flat(value):
    return [number for part in value for number in flat(part)] if isinstance(value, list) else [float(value)]


def agree(found, expected, tolerance):
    bar = tolerance * max(map(abs, expected), default=0.0)
    return len(found) == len(expected) and all(abs(a - b) <= bar for a, b in zip(found, expected))


def numbers(value):
    """The numbers of an answer; none where something else stands among them."""
    try:
        return flat(value)
    except (TypeError, ValueError):
        return []


def faults(vector, own, mistakes):
    """What is wrong with the answer to a vector, mistake by mistake."""
    if "refused" in vector:
        right, given = vector["refused"], own.get("refused")
        if given is None:
            return [f"{', '.join(own)}: a number where a refusal is right ({right})"]
        return [] if given == right else [f"refused as {given}, where it is {right}"]
    if "refused" in own:
        return [f"refused as {own['refused']}, and has an answer"]
    by_mistake = {}
    for key, expected in vector["answer"].items():
        found = numbers(own[key]) if key in own else None
        if found is None or agree(found, flat(expected), vector["tolerance"]):
            continue
        known = [m for m in mistakes if m["key"] == key and agree(found, flat(m["answer"]), NAMED)]
        names = [f"{m['what']} in ({m['equation']})" if "equation" in m else f'"{m["what"]}"' for m in known]
        by_mistake.setdefault(" or ".join(names), []).append(key)
    say = lambda keys, name: f"{', '.join(keys)} {'is' if len(keys) == 1 else 'are'} {'that of ' + name if name else 'not the known answer'}"
    return [say(keys, name) for name, keys in by_mistake.items()]


def explained_in(vector):
    """The chapters of the tour that explain a vector: one or two."""
    chapter = vector["chapter"]
    return chapter if isinstance(chapter, list) else [chapter]


def mark(vectors, wrong_answers, answers):
    """A line for each wrong vector, and how many of all answers are right, wrong and missing."""
    lines, right, missing = [], 0, 0
    for vector in vectors:
        own, keys = answers.get(vector["name"]) or {}, list(vector.get("answer", ["refused"]))
        if not own:
            missing += len(keys)
            continue
        mistakes = [m for m in wrong_answers if m["vector"] == vector["name"]] + vector.get("mistakes", [])
        found = faults(vector, own, mistakes)
        missing += 0 if "refused" in vector or "refused" in own else sum(key not in own for key in keys)
        right += not found
        if found:
            of = ", ".join([f"({equation})" for equation in vector["equations"]] or vector["sentences"])
            lines.append(f"{vector['name']}, {of}: {'; '.join(found)}")
    return lines, right, missing


def main(arguments):
    vectors = json.loads((HERE / "vectors.json").read_text())["vectors"]
    if arguments[:1] == ["--chapter"]:
        chapters = sorted({chapter for vector in vectors for chapter in explained_in(vector)})
        vectors = [vector for vector in vectors if "".join(arguments[1:2]) in map(str, explained_in(vector))]
        if not vectors:
            sys.exit(f"--chapter {' '.join(arguments[1:2])}: the chapters with vectors are {', '.join(map(str, chapters))}")
        arguments = arguments[2:]
    if len(arguments) != 1:
        sys.exit(__doc__)
    answers = json.loads(pathlib.Path(arguments[0]).read_text())
    lines, right, missing = mark(vectors, json.loads((HERE / "wrong_answers.json").read_text()), answers)
    print(*lines, sep="\n", end="\n" if lines else "")
    unknown = sorted(set(answers) - {vector["name"] for vector in json.loads((HERE / "vectors.json").read_text())["vectors"]})
    print(f"{right} vectors right, {len(lines)} wrong, {missing} answers missing" + (f"; no vector is named {', '.join(unknown)}" if unknown else ""), file=sys.stderr)
    return 1 if lines else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
