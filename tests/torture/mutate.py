# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutants of every kind of file that argil reads: damaged where the format has its joints, with lengths
and checksums made right again in some, so that the damage reaches the inner parser."""
import io
import json
import math
import struct
import zipfile

NUMBERS = ["0", "-0", "1", "-1", "1e-400", "1e-40", "3.4e38", "-3.4e38", "1e39", "1.8e308", "1e309", "nan", "inf",
           "-inf", "NaN", "1e6", "1000001", "-1e7", "9e15", "2147483647", "2147483648", "-2147483648", "4294967295",
           "4294967296", "9223372036854775807", "18446744073709551616", "0x10", "1e", "--1", "1,5", ""]
FLOATS = [0.0, -0.0, 1e-45, 1e-30, 1e6, 1.0001e6, -1e7, 3.4e38, -3.4e38, math.nan, math.inf, -math.inf]
SEAL_BYTES = 24
INTEGERS = [0, 1, 2, 0x7f, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, 1 << 30]


def damage_bytes(random, data, times=None):
    """Bytes changed, cut, repeated and swapped, wherever they are."""
    data = bytearray(data)
    for _ in range(times or random.randint(1, 4)):
        if not data:
            return bytes(data)
        at = random.randrange(len(data))
        size = random.choice((1, 1, 2, 4, 8, 16, 64))
        how = random.randrange(7)
        if how == 0:
            data[at] = random.randrange(256)
        elif how == 1:
            data[at] ^= 1 << random.randrange(8)
        elif how == 2:
            data[at:at + 4] = struct.pack("<I", random.choice(INTEGERS))
        elif how == 3:
            data[at:at + 4] = struct.pack("<f", random.choice(FLOATS))
        elif how == 4:
            del data[at:at + size]
        elif how == 5:
            other = random.randrange(len(data))
            data[at:at] = data[other:other + size]
        else:
            del data[at:]
    return bytes(data)


def damage_text(random, text):
    """Numbers replaced, words and lines cut, repeated and swapped."""
    lines = text.split("\n")
    for _ in range(random.randint(1, 4)):
        at = random.randrange(len(lines))
        how = random.randrange(9)
        if how < 4:
            words = lines[at].split(" ")
            if how == 3 and len(words) > 1:
                del words[random.randrange(len(words))]
            else:
                spots = [n for n, word in enumerate(words) if any(c.isdigit() for c in word)] or [0]
                words[random.choice(spots)] = random.choice(NUMBERS)
            lines[at] = " ".join(words)
        elif how == 4:
            del lines[at]
            lines = lines or [""]
        elif how == 5:
            line = lines[random.randrange(len(lines))]
            # A thousand operations on all of the clay are no damage but an evening's work.
            most = 3 if '"operation"' in line else 1000
            lines[at:at] = [line] * random.choice((1, 1, 1, most))
        elif how == 6:
            other = random.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        elif how == 7:
            lines[at] += random.choice((" ", "\t", "\r", "\0", "x", "\xff", '"', "{" * 200, "9" * 5000))
        else:
            lines = lines[:at] + [lines[at][:random.randrange(len(lines[at]) + 1)]]
    return "\n".join(lines)


def damage_tree(random, tree, depth=0):
    """A JSON value with one thing of it replaced, left out, repeated or nested."""
    if isinstance(tree, dict) and tree and random.random() < 0.85:
        key = random.choice(list(tree))
        tree = dict(tree)
        how = random.randrange(6)
        if how == 0:
            del tree[key]
        elif how == 1:
            tree[key + "x"] = tree[key]
        else:
            tree[key] = damage_tree(random, tree[key], depth + 1)
        return tree
    if isinstance(tree, list) and tree and random.random() < 0.85:
        tree = list(tree)
        at = random.randrange(len(tree))
        how = random.randrange(6)
        if how == 0:
            del tree[at]
        elif how == 1:
            tree[at:at] = [tree[random.randrange(len(tree))]] * random.choice((1, 1, 1000))
        else:
            tree[at] = damage_tree(random, tree[at], depth + 1)
        return tree
    if isinstance(tree, str) and tree and random.random() < 0.5:
        at = random.randrange(len(tree))
        return tree[:at] + random.choice(("", "x", "/", "..", "\0", "é", "y" * 3000)) + tree[at + 1:]
    nested = []
    for _ in range(random.choice((1, 1, 1, 500))):
        nested = [nested]
    return random.choice((None, True, "", "text", [], {}, nested, 0, -1, 0.5, 1e6, 1.1e6, -1e9, 3.4e38, 1e308,
                          -1e-300, 2147483647, 2147483648, 4294967295, 2**63, -2**63, 10**30))


def dumped(tree):
    return json.dumps(tree, allow_nan=True)


def mutate_json(random, data):
    text = data.decode("utf-8")
    if random.random() < 0.3:
        return damage_text(random, text).encode("utf-8", "surrogatepass")
    return dumped(damage_tree(random, json.loads(text))).encode("utf-8", "replace")


def mutate_json_lines(random, data):
    lines = data.decode("utf-8").splitlines()
    if random.random() < 0.3:
        return damage_text(random, "\n".join(lines)).encode("utf-8", "surrogatepass")
    at = random.randrange(len(lines))
    lines[at] = dumped(damage_tree(random, json.loads(lines[at])))
    if random.random() < 0.2:
        lines[at:at] = [lines[random.randrange(len(lines))]] * 3
    return "\n".join(lines + [""]).encode("utf-8", "replace")


def mutate_text(random, data):
    if random.random() < 0.2:
        return damage_bytes(random, data)
    return damage_text(random, data.decode("latin-1")).encode("latin-1", "replace")


def mutate_stl(random, data):
    """Binary: the count made right for what is cut or repeated in half of them."""
    head, facets = data[:80], [data[at:at + 50] for at in range(84, len(data), 50)]
    if random.random() < 0.2:
        return damage_bytes(random, data)
    for _ in range(random.randint(1, 4)):
        at = random.randrange(len(facets))
        how = random.randrange(4)
        if how == 0:
            numbers = list(struct.unpack("<12f", facets[at][:48]))
            numbers[random.randrange(12)] = random.choice(FLOATS)
            facets[at] = struct.pack("<12f", *numbers) + facets[at][48:]
        elif how == 1 and len(facets) > 1:
            del facets[at]
        elif how == 2:
            facets[at:at] = [facets[random.randrange(len(facets))]] * random.choice((1, 1, 500))
        else:
            numbers = list(struct.unpack("<12f", facets[at][:48]))
            numbers[3:12] = numbers[6:12] + numbers[3:6] if random.random() < 0.5 else [numbers[3]] * 9
            facets[at] = struct.pack("<12f", *numbers) + facets[at][48:]
    count = len(facets) if random.random() < 0.6 else random.choice(INTEGERS)
    return head + struct.pack("<I", count) + b"".join(facets)


def mutate_ply(random, data):
    """Binary: the header as text, or the body as numbers."""
    end = data.index(b"end_header\n") + len(b"end_header\n")
    head, body = data[:end], data[end:]
    if random.random() < 0.5:
        head = damage_text(random, head.decode("latin-1")).encode("latin-1", "replace")
    else:
        body = damage_bytes(random, body)
    return head + body


def mutate_zip(random, data):
    """The XML inside, packed again; or the archive."""
    if random.random() < 0.25:
        return damage_bytes(random, data)
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as archive, zipfile.ZipFile(out, "w") as written:
        names = archive.namelist()
        hit = random.choice(names)
        for name in names:
            content = archive.read(name)
            if name == hit:
                content = damage_xml(random, content.decode("utf-8")).encode("utf-8", "replace")
                if random.random() < 0.1:
                    name = random.choice(("", "../" + name, name * 200, "3D/other.model"))
            how = random.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
            written.writestr(zipfile.ZipInfo(name), content, compress_type=how)
    return damage_bytes(random, out.getvalue(), 1) if random.random() < 0.1 else out.getvalue()


def damage_xml(random, text):
    parts = text.replace("<", "\n<").split("\n")
    for _ in range(random.randint(1, 3)):
        at = random.randrange(len(parts))
        how = random.randrange(6)
        if how < 2 and '"' in parts[at]:
            pieces = parts[at].split('"')
            pieces[random.randrange(1, len(pieces), 2)] = random.choice(NUMBERS)
            parts[at] = '"'.join(pieces)
        elif how == 2:
            del parts[at]
            parts = parts or [""]
        elif how == 3:
            parts[at:at] = [parts[random.randrange(len(parts))]] * random.choice((1, 1, 300))
        elif how == 4:
            other = random.randrange(len(parts))
            parts[at], parts[other] = parts[other], parts[at]
        else:
            parts[at] = random.choice(("<!DOCTYPE x [<!ENTITY a 'aa'>]>", "&a;", "<!--", "<![CDATA[", "<x>" * 300,
                                       parts[at][:len(parts[at]) // 2]))
    return "".join(parts)


def mutate_glb(random, data):
    """The scene's JSON with its lengths made right, the numbers of its buffer, or the bytes."""
    size, = struct.unpack_from("<I", data, 12)
    scene, rest = data[20:20 + size], data[20 + size:]
    how = random.random()
    if how < 0.2:
        return damage_bytes(random, data)
    if how < 0.6:
        scene = dumped(damage_tree(random, json.loads(scene))).encode("utf-8", "replace")
        scene += b" " * (-len(scene) % 4)
    else:
        numbers = damage_bytes(random, rest[8:])
        length = struct.pack("<I", len(numbers)) if random.random() < 0.8 else rest[:4]
        rest = length + rest[4:8] + numbers
    total = 20 + len(scene) + len(rest)
    return struct.pack("<4sIIII", b"glTF", 2, total, len(scene), 0x4e4f534a) + scene + rest


def mutate_vdb(random, data):
    """Without its seal, which whoever runs it puts behind: half of the damage in the head."""
    body = bytearray(data[:-SEAL_BYTES])
    for _ in range(random.randint(1, 3)):
        at = random.randrange(min(2500, len(body) - 8) if random.random() < 0.5 else len(body) - 8)
        how = random.randrange(6)
        if how == 0:
            body[at] = random.randrange(256)
        elif how == 1:
            body[at:at + 4] = struct.pack("<I", random.choice(INTEGERS))
        elif how == 2:
            body[at:at + 8] = struct.pack("<q", random.choice((0, -1, -2048, 1 << 40, -(1 << 62), 2**63 - 1)))
        elif how == 3:
            body[at:at + 4] = struct.pack("<f", random.choice(FLOATS))
        elif how == 4:
            del body[at:at + random.choice((1, 4, 8, 64))]
        else:
            other = random.randrange(len(body) - 64)
            body[at:at] = body[other:other + random.choice((1, 8, 64))]
    return bytes(body)
