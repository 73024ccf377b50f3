#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how the sources are arranged, and fails where a folder includes one that stands above it.

Usage: tests/structure.py [FOLDER]   the root of a checkout; default: this one

The order of each library's folders is read from cmake/ArgilLayers.cmake (ARGIL_FOLDERS_*, the lowest
first), which stops CMake on the same faults. A public header belongs to the folder whose source has its
name, and without one to the highest folder that it includes. Exit status 1 when there is an arrow upwards, a
circle, an include with `..` in its path, a file of the evaluation or of Python that includes more of cli than
cli/common and cli/lab, a type that is defined twice, a library with fewer asserts than LEAST_ASSERTS, or code of
others compiled in whose licence cmake/package/copyright does not name.
"""
import collections
import pathlib
import re
import statistics
import sys

ROOTS = {  # library: where its private includes begin
    "core": "engine/core/src", "engine": "engine/src", "mesh": "mesh/src", "haptics": "haptics/src",
    "io": "io/src", "viewer": "viewer/src", "evaluation": "evaluation", "cli": "cli",
    "python": "python/src",
}
PUBLIC = {"core": "engine/core/include", "engine": "engine/include", "mesh": "mesh/include",
          "haptics": "haptics/include", "io": "io/include", "viewer": "viewer/include"}
TESTS = {"io": ("io", "readers")}  # library: folders of its tests; where none is named, the one of its name
LEAST_ASSERTS = {"engine": 8.0, "mesh": 8.0, "haptics": 8.0}  # per 1000 lines, those made at run time
# Of the system, and of shared libraries that carry their licences themselves: headers that only declare.
ONLY_CALLED = set("""sys netinet arpa X11 GLFW epoxy
    blosc.h gmp.h jerror.h jpeglib.h libusb.h meshoptimizer.h png.h sodium.h spnav.h zlib.h
    emmintrin.h fcntl.h immintrin.h malloc.h poll.h pthread.h sched.h spawn.h stdlib.h time.h unistd.h""".split())
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.M)
CONTROL = {"if", "for", "while", "switch", "catch", "return", "sizeof", "decltype", "alignas"}


def sources(root, folder):
    base = root / folder
    return sorted(p for p in base.rglob("*") if p.suffix in (".h", ".cpp")) if base.is_dir() else []


def folder_orders(root):
    text = (root / "cmake/ArgilLayers.cmake").read_text()
    return {name: words.split()
            for name, words in re.findall(r"set\(ARGIL_FOLDERS_(\w+)\s+([^)]*)\)", text)}


class Library:
    """The folders of one library, its files and what they include of each other."""

    def __init__(self, root, name, order=()):
        self.name = name
        self.order = list(order)
        self.base = root / ROOTS[name]
        self.headers = root / PUBLIC.get(name, "nowhere") / "argil" / name
        self.files = sources(root, ROOTS[name]) + sources(root, self.headers.relative_to(root))
        self.by_stem = {p.stem: self.private_folder(p) for p in self.files
                        if p.suffix == ".cpp" and self.base in p.parents}

    def private_folder(self, path):
        parts = path.relative_to(self.base).parts
        return parts[0] if len(parts) > 1 else ""

    def own_folder(self, path):
        """By a file's place, or by the source of its name; None for a public header that has neither."""
        if self.base in path.parents:
            return self.private_folder(path)
        parts = path.relative_to(self.headers).parts
        return parts[0] if len(parts) > 1 else self.by_stem.get(path.stem)

    def folder(self, path):
        """Where a file stands: a header without a place of its own in the highest folder that it includes, if
        need be through others of its kind. Empty for what stands above all folders, None for plain types."""
        highest, waiting, seen = self.own_folder(path), [path], {path}
        if highest is not None:
            return highest
        while waiting:
            for other in self.included(waiting.pop()):
                above = self.own_folder(other)
                if above is not None:
                    highest = above if highest is None else max(highest, above, key=self.rank)
                elif other not in seen:
                    seen.add(other)
                    waiting.append(other)
        return highest

    def rank(self, folder):
        return self.order.index(folder) if folder in self.order else len(self.order)

    def room(self, path):
        """A source and its private header are one room; a public header is one of its own."""
        if self.base in path.parents:
            return f"{self.private_folder(path)}/{path.stem}"
        return str(path.relative_to(self.headers.parent))

    def included(self, path):
        for name in INCLUDE.findall(path.read_text(errors="replace")):
            for place in (self.base / name, path.parent / name,
                          self.headers.parent.parent / name):
                if place.is_file():
                    place = place.resolve()
                    if self.base in place.parents or self.headers in place.parents:
                        yield place
                    break

    def graph(self, node):
        arrows = collections.defaultdict(dict)
        for path in self.files:
            for other in self.included(path):
                a, b = node(path), node(other)
                if a is not None and b is not None and a != b:
                    arrows[a].setdefault(b, f"{path.name} includes {other.name}")
        return arrows


def circles(arrows):
    """Strongly connected parts of more than one node (Tarjan 1972)."""
    index, low, stack, on, found = {}, {}, [], set(), []

    def visit(v):
        index[v] = low[v] = len(index)
        stack.append(v)
        on.add(v)
        for w in arrows.get(v, ()):
            if w not in index:
                visit(w)
                low[v] = min(low[v], low[w])
            elif w in on:
                low[v] = min(low[v], index[w])
        if low[v] == index[v]:
            part = []
            while not part or part[-1] != v:
                part.append(stack.pop())
                on.discard(part[-1])
            if len(part) > 1:
                found.append(sorted(map(str, part)))

    sys.setrecursionlimit(10000)
    for v in list(arrows):
        if v not in index:
            visit(v)
    return found


def bare(text):
    """The text without comments and the inside of strings, line for line."""
    token = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.S)

    def blank(match):
        first = match.group(0)[0]
        return ('""' if first in 'R"' else "0" if first == "'" else "") + "\n" * match.group(0).count("\n")

    return token.sub(blank, text)


def blocks(text):
    """(kind, name, first line, last line, namespaces) of the functions and types of a source."""
    text = bare(text)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.M)
    stack, head, line, found = [], "", 1, []
    for c in text:
        if c == "\n":
            line += 1
        if c == "{":
            stack.append((*classify(head, stack), line - head.lstrip().count("\n")))
            head = ""
        elif c == "}":
            if stack:
                kind, name, first = stack.pop()
                if kind in ("function", "type"):
                    found.append((kind, name, first, line, [n for k, n, _ in stack if k != "other"]))
            head = ""
        elif c == ";":
            head = ""
        else:
            head += c
    return found


def classify(head, stack):
    inside = stack[-1][0] if stack else "space"
    words = head.split()
    if inside not in ("space", "type") or not words:
        return "other", ""
    if "namespace" in words:
        name = words[words.index("namespace") + 1:]
        return "space", name[0] if name else "(anonymous)"
    match = re.search(r"\b(?:class|struct|union|enum)\s+(?:class\s+)?(?:alignas\([^)]*\)\s*)?([\w:]+)", head)
    before = head[:match.start()] if match else head
    if match and "(" not in before and "template" not in before and "=" not in head:
        return "type", match.group(1)
    match = re.search(r"([\w~:]+|operator\W+)\s*\(", head)
    if match and match.group(1) not in CONTROL and not head.rstrip().endswith("="):
        return "function", match.group(1)
    return ("space", "extern") if words[0] == "extern" else ("other", "")


def comment_share(paths):
    comments = lines = 0
    for path in paths:
        for text in path.read_text(errors="replace").splitlines():
            lines += bool(text.strip())
            comments += text.strip().startswith(("//", "/*", "*"))
    return 100.0 * comments / max(lines, 1)


def report_folders(root, orders):
    faults = []
    print(f"{'library':12}{'files':>6}{'folders':>8}{'largest':>9}{'up':>4}{'circles':>8}{'of files':>9}")
    for name in ROOTS:
        library = Library(root, name, orders.get(name, []))
        if not library.files:
            continue
        counts = collections.Counter(p.parent for p in library.files)
        arrows = library.graph(library.folder)
        up = [f"{name}: {a or 'top'} -> {b or 'top'}: {why}" for a in arrows for b, why in arrows[a].items()
              if library.order and library.rank(b) > library.rank(a)]
        unknown = {library.own_folder(p) for p in library.files} - {"", None, *library.order}
        up += [f"{name}: the folder {f} is in no list of cmake/ArgilLayers.cmake" for f in sorted(unknown)]
        rings = circles(arrows)
        small = circles(library.graph(library.room))
        faults += up + [f"{name}: a circle of folders: {' '.join(r)}" for r in rings]
        faults += [f"{name}: a circle of files: {' '.join(r)}" for r in small]
        print(f"{name:12}{len(library.files):6}{len(counts):8}{max(counts.values()):9}{len(up):4}"
              f"{len(rings):8}{len(small):9}")
    return faults


def strange_includes(root):
    """Includes that go round the folders by `..`, and those of the evaluation and of Python that lie in cli but
    not in cli/common or cli/lab."""
    faults = []
    for folder in sorted({*ROOTS.values(), *PUBLIC.values(), "tests", "examples"}):
        for path in sources(root, folder):
            for name in INCLUDE.findall(path.read_text(errors="replace")):
                place = path.relative_to(root)
                if {"", ".", ".."} & set(name.split("/")):
                    faults.append(f"{place} includes {name}")
                elif folder in ("evaluation", "python/src") and (root / "cli" / name).is_file() and \
                        not name.startswith(("common/", "lab/")) and \
                        not any((beside / name).is_file() for beside in (path.parent, root / folder)):
                    faults.append(f"{place} includes {name} of cli")
    return faults


def unlicensed(root):
    """Libraries, by the folders or headers that are included of them, that no paragraph of the copyright names."""
    paragraphs = re.findall(r"^Files: (.*)", (root / "cmake/package/copyright").read_text(), re.M)
    named = {word.removesuffix("/*") for words in paragraphs for word in words.split()}
    found = {}
    for folder in {*ROOTS.values(), *PUBLIC.values()}:
        for path in sources(root, folder):
            for name in re.findall(r"^[ \t]*#[ \t]*include[ \t]*<(\w+(?=/)|\w+\.h)", path.read_text(errors="replace"), re.M):
                if name not in named | ONLY_CALLED:
                    found.setdefault(name, path.relative_to(root))
    return [f"{place} includes {name}, whose licence is not in cmake/package/copyright"
            for name, place in sorted(found.items())]


def report_functions(root):
    faults = []
    print(f"\n{'library':12}{'functions':>10}{'median':>7}{'p90':>5}{'max':>5}  {'comments: public, sources':26}"
          f"{'asserts per 1000 lines':>23}")
    everything = []
    for name in ROOTS:
        library = Library(root, name)
        if not library.files:
            continue
        lengths, asserts, lines = [], 0, 0
        for path in library.files:
            text = path.read_text(errors="replace")
            lengths += [last - first + 1 for kind, _, first, last, _ in blocks(text) if kind == "function"]
            asserts += len(re.findall(r"\bassert\s*\(", bare(text)))
            lines += text.count("\n")
        everything += lengths
        public = [p for p in library.files if library.headers in p.parents]
        private = [p for p in library.files if library.base in p.parents]
        shares = f"{comment_share(public):.0f} %, {comment_share(private):.0f} %" if public else \
            f"-, {comment_share(private):.0f} %"
        print(f"{name:12}{len(lengths):10}{statistics.median(lengths):7.0f}{quantile(lengths, .9):5}"
              f"{max(lengths):5}  {shares:26}{1000 * asserts / lines:23.1f}")
        if 1000 * asserts / lines < LEAST_ASSERTS.get(name, 0.0):
            faults.append(f"{name}: {1000 * asserts / lines:.1f} asserts per 1000 lines; "
                          f"at least {LEAST_ASSERTS[name]:.0f}")
    print(f"{'all':12}{len(everything):10}{statistics.median(everything):7.0f}{quantile(everything, .9):5}"
          f"{max(everything):5}")
    return faults


def report_tests(root):
    """Of the files with tests: how many lie in the folder, and have the name, of a source that they test. A name
    may go on after the source's, as servo_realtime for servo does."""
    print(f"\n{'library':12}{'test files':>11}{'by folder':>10}{'by folder and name':>19}")
    for name in ROOTS:
        library = Library(root, name)
        stems = collections.defaultdict(set)
        for path in library.files:
            stems[library.own_folder(path)].add(path.stem)
        places = []
        for program in TESTS.get(name, (name,)):
            base = root / "tests" / program
            places += [(p.relative_to(base).parts[:-1], p.stem) for p in sources(root, f"tests/{program}")
                       if re.search(r"^TEST(_P|_F)?\(", p.read_text(errors="replace"), re.M)]
        if not places:
            continue
        by_folder = by_name = 0
        for parts, stem in places:
            folder = parts[0] if parts else ""
            by_folder += folder in stems
            words = stem.split("_")
            beginnings = {"_".join(words[:n]) for n in range(1, len(words) + 1)}
            by_name += bool(beginnings & (stems[folder] | stems[None])) if folder in stems else 0
        print(f"{name:12}{len(places):11}{100 * by_folder / len(places):8.0f} %{100 * by_name / len(places):17.0f} %")


def quantile(values, q):
    return sorted(values)[min(len(values) - 1, int(q * len(values)))]


def doubles(root):
    """Types of one qualified name that are defined in two places."""
    homes = collections.defaultdict(set)
    for name in ROOTS:
        for path in Library(root, name).files:
            for kind, word, first, _, spaces in blocks(path.read_text(errors="replace")):
                if kind == "type" and "(anonymous)" not in spaces:
                    homes["::".join([*spaces, word])].add(f"{path.relative_to(root)}:{first}")
    return [f"{word} is defined in {', '.join(sorted(places))}"
            for word, places in sorted(homes.items()) if len({p.split(":")[0] for p in places}) > 1]


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    orders = folder_orders(root)
    faults = report_folders(root, orders) + strange_includes(root) + report_functions(root)
    report_tests(root)
    twice = doubles(root)
    faults += unlicensed(root)
    print(f"\ntypes defined twice: {len(twice)}")
    for fault in faults + twice:
        print(f"FAULT {fault}")
    return 1 if faults or twice else 0


if __name__ == "__main__":
    sys.exit(main())
