# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a batch: a table for programs, a page for people."""
import base64
import csv
import html
import io
import os

COLUMNS = ("file", "status", "message", "output", "problems_given", "repaired_by", "triangles",
           "volume_mm3", "size_x_mm", "size_y_mm", "size_z_mm", "seconds")
STYLE = """body{font:15px/1.4 sans-serif;margin:2em;color:#222;background:#fafafa}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(210px,1fr));gap:14px}
figure{margin:0;padding:8px;background:#fff;border:1px solid #ddd;border-left:5px solid #4c9f70}
figure.no{border-left-color:#e9a23b}figure.failed{border-left-color:#c8553d}
img,.none{width:100%;aspect-ratio:5/4;display:block;background:#eee}
figcaption{overflow-wrap:anywhere;font-size:13px}b{font-size:15px}"""


def replace(file, text):
    part = file.with_name(f".{file.name}.{os.getpid()}")
    part.write_text(text, encoding="utf-8", newline="")
    os.replace(part, file)


def table(records):
    text = io.StringIO()
    rows = csv.DictWriter(text, COLUMNS, extrasaction="ignore", restval="")
    rows.writeheader()
    for record in records:
        size = record.get("size_mm") or ("", "", "")
        rows.writerow({**record, **dict(zip(("size_x_mm", "size_y_mm", "size_z_mm"), size))})
    return text.getvalue()


def card(out, record):
    kind = {"printable": "", "not printable": "no"}.get(record["status"], "failed")
    picture = out / "records" / (record["file"] + ".png")
    shown = '<div class="none"></div>'
    if kind != "failed" and picture.exists():
        data = base64.b64encode(picture.read_bytes()).decode()
        shown = f'<img alt="" src="data:image/png;base64,{data}">'
    lines = [f"<b>{html.escape(record['file'])}</b>", record["status"]]
    if record["message"]:
        lines.append(html.escape(record["message"]))
    if record["output"]:
        size = " × ".join(f"{side:.1f}" for side in record["size_mm"])
        lines += [f"{size} mm, {record['volume_mm3'] / 1000:.2f} cm³",
                  f"{record['triangles']} triangles, {record['problems_given']} problems given"]
    return f'<figure class="{kind}">{shown}<figcaption>{"<br>".join(lines)}</figcaption></figure>'


def write_report(out, records, meshes):
    """report.csv and report.html, which needs no other file, of what is done of so many meshes."""
    replace(out / "report.csv", table(records))
    counts = {}
    for record in records:
        counts[record["status"]] = counts.get(record["status"], 0) + 1
    told = ", ".join(f"{count} {status}" for status, count in sorted(counts.items()))
    order = {"failed": 0, "not printable": 1}
    cards = "\n".join(card(out, record) for record in
                      sorted(records, key=lambda each: order.get(each["status"], 2)))
    replace(out / "report.html", f"""<!doctype html><html lang="en"><meta charset="utf-8">
<title>Batch</title><style>{STYLE}</style>
<h1>{len(records)} of {meshes} meshes</h1><p>{told}</p>
<main>
{cards}
</main></html>
""")
