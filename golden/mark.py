"""Marks an implementation of the method, in whatever language, by the known answers of vectors.json.

    python3 golden/mark.py answers.json

answers.json has an object under each vector's name, such as {"sorting and error sum": {"frequency_error": 0.1, ...}, ...}, with the keys
and the shapes of its `answer` for its `input`. A number may be off by `tolerance` times the largest of its answer.
"""
import json
import pathlib
import sys


def flat(value):
    return [number for part in value for number in flat(part)] if isinstance(value, list) else [float(value)]


def main():
    known = json.loads((pathlib.Path(__file__).parent / "vectors.json").read_text())["vectors"]
    answers, wrong = json.loads(pathlib.Path(sys.argv[1]).read_text()), 0
    for vector in known:
        for key, expected in vector["answer"].items():
            expected, found = flat(expected), flat(answers.get(vector["name"], {}).get(key, []))
            bar = vector["tolerance"] * max(map(abs, expected))
            if len(found) != len(expected) or not all(abs(a - b) <= bar for a, b in zip(found, expected)):
                wrong += 1
                print(f"{vector['name']} ({', '.join(vector['equations'])}): {key} is not the known answer")
    sys.exit(f"{wrong} answers are wrong" if wrong else None)


if __name__ == "__main__":
    main()
