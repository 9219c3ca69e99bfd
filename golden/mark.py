"""Marks an implementation of the method, in whatever language, by the known answers of vectors.json.

    python3 golden/mark.py answers.json

answers.json has an object under each vector's name, such as {"sorting and error sum": {"frequency_error": 0.1, ...}, ...}, with the keys
and the shapes of its `answer` for its `input`. A number may be off by `tolerance` times the largest of its answer. Where a wrong answer
is that of a known mistake (wrong_answers.json), the mistake is named; what is not answered is counted, and is not wrong.
"""
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
NAMED = 1e-5  # six digits of a wrong answer are stored


def flat(value):
    return [number for part in value for number in flat(part)] if isinstance(value, list) else [float(value)]


def agree(found, expected, tolerance):
    bar = tolerance * max(map(abs, expected))
    return len(found) == len(expected) and all(abs(a - b) <= bar for a, b in zip(found, expected))


def main():
    known = json.loads((HERE / "vectors.json").read_text())["vectors"]
    mistakes = json.loads((HERE / "wrong_answers.json").read_text())
    answers, wrong, missing = json.loads(pathlib.Path(sys.argv[1]).read_text()), 0, 0
    for vector in known:
        own = answers.get(vector["name"], {})
        for key, expected in vector["answer"].items():
            if key not in own:
                missing += 1
                continue
            found = flat(own[key])
            if not agree(found, flat(expected), vector["tolerance"]):
                wrong += 1
                here = [m for m in mistakes if (m["vector"], m["key"]) == (vector["name"], key) and agree(found, flat(m["answer"]), NAMED)]
                names = " or ".join(f"{m['what']} in ({m['equation']})" for m in here)
                print(f"{vector['name']} ({', '.join(vector['equations'])}): {key} is {'that of ' + names if names else 'not the known answer'}")
    if missing:
        print(f"{missing} answers are missing")
    sys.exit(f"{wrong} answers are wrong" if wrong else None)


if __name__ == "__main__":
    main()
