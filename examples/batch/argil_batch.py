# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 argil_batch.py FOLDER -o RESULTS [--workers N | --scheduler ADDRESS]

Repairs, hollows, checks and exports every mesh of a folder, in worker processes of Dask (Debian:
python3-distributed): a cluster on this machine, or one whose scheduler is named and whose workers see
both folders under the same paths.

Run again, it does only what is not done: new and changed files, and all of them where the options
or the printer's profile changed. RESULTS holds NAME.ENDING.3mf and, in `records`, what was found and a
picture of each; report.csv and report.html are made of these. Exit status: 0 all is done; 1 some files
failed, the report says why; 130 Ctrl-C, with what was done until then in the report.
"""
import argparse
import contextlib
import hashlib
import json
import os
import pathlib
import sys
import time

import dask
import distributed
from batch_report import write_report

ENDINGS = (".obj", ".stl", ".ply", ".glb", ".gltf", ".3mf")
DEATHS = 2  # of its worker, after which a file has failed


def record_of(file, out):
    """Where the record of a file is kept."""
    return out / "records" / (file.name + ".json")


def write_whole(file, data):
    """A reader finds the former file or the whole new one."""
    part = file.with_name(f".{file.name}.{os.getpid()}")
    part.write_bytes(data)
    os.replace(part, file)


def write_record(file, out, record):
    write_whole(record_of(file, out), json.dumps(record, indent=1).encode())


def content_hash(file):
    return hashlib.blake2b(file.read_bytes(), digest_size=16).hexdigest()


def identity(file):
    """What tells whether a file has changed."""
    about = file.stat()
    return {"bytes": about.st_size, "modified_ns": about.st_mtime_ns, "hash": content_hash(file)}


def done_before(file, out, options):
    """The record of an earlier run that still holds; else None. A touched file is read, others are not."""
    try:
        record = json.loads(record_of(file, out).read_text())
        about, then = file.stat(), record["input"]
        if record["options"] != options or about.st_size != then["bytes"]:
            return None
        if about.st_mtime_ns != then["modified_ns"] and content_hash(file) != then["hash"]:
            return None
        return record if not record["output"] or (out / record["output"]).exists() else None
    except (OSError, ValueError, KeyError, TypeError):
        return None


def make(file, target, picture, options):
    """One mesh to one print. What the report says of it."""
    import argil
    given = argil.Mesh.load(file, unit=options["unit"])
    problems = len(given.check()["problems"])
    whole, repaired = given.repair(allow_loss=options["allow_loss"])
    clay = argil.Clay.from_mesh(whole, voxel_mm=options["voxel_mm"] or None,
                                resolution=options["resolution"])
    note = ""
    if options["wall_mm"]:
        vertices = clay.surface().vertices
        lowest = vertices[vertices[:, 2].argmin()]
        try:
            clay.hollow(options["wall_mm"], drains=[(lowest, (0, 0, 1), options["drain_mm"])])
        except argil.BadInput as error:
            note = f"left solid: {error}"
    exported = clay.export(target, max_error_mm=options["max_error_mm"])
    checked = argil.Mesh.load(target).check(printer=options["printer"] or None)
    write_whole(picture, argil.picture.png(argil.render(clay, size=(200, 160), samples=2)))
    kinds = sorted({problem["kind"] for problem in checked["problems"]})
    return {"status": "printable" if checked["printable"] else "not printable",
            "message": note or ", ".join(kinds), "problems_given": problems,
            "repaired_by": repaired["way"], "triangles": exported["triangles"],
            "volume_mm3": checked["volume_mm3"], "size_mm": checked["size_mm"]}


def treat(file, out, options, threads):
    """What a worker does with a file: its record, which is on the disk when this returns. Broken input
    is a record, too."""
    import argil
    done = done_before(file, out, options)
    if done:  # by a worker that was killed before it could say so
        return done
    argil.set_threads(threads)
    record = {"file": file.name, "options": options, "input": {}, "output": "", "status": "failed"}
    target = out / f"{file.name}.3mf"  # two files that differ in their ending alone are two prints
    began = time.monotonic()
    try:
        record["input"] = identity(file)
        record.update(make(file, target, record_of(file, out).with_suffix(".png"), options))
        record["output"] = target.name
    except Exception as error:  # whatever is wrong with one file, the others go on
        record["message"] = f"{type(error).__name__}: {error.args[0] if error.args else error}"
    record["seconds"] = round(time.monotonic() - began, 2)
    write_record(file, out, record)
    return record


def run(client, files, out, options, threads):
    """Yields a file and its record as they are done. No more is handed out than there are workers: those
    that wait for a worker would be blamed for its death, too."""
    waiting, names = iter(files), {}
    running = distributed.as_completed()

    def hand_out():
        for file in waiting:
            future = client.submit(treat, file, out, options, threads, pure=False)
            names[future.key] = file
            running.add(future)
            return

    for _ in range(max(1, len(client.ncores()))):
        hand_out()
    for future in running:
        file, error, known = names.pop(future.key), future.exception(), {}
        if error is None:
            record = future.result()
        else:  # KilledWorker: Dask tried DEATHS times
            died = isinstance(error, distributed.KilledWorker)
            with contextlib.suppress(OSError):
                known = identity(file)
            record = {"file": file.name, "options": options, "input": known, "output": "",
                      "status": "failed", "message": "its worker died each time: out of memory or a "
                      f"fault of a program ({type(error).__name__})" if died else repr(error)}
            write_record(file, out, record)
        yield file, record
        hand_out()


@contextlib.contextmanager
def connected(given):
    """A client, and the threads of Argil in each worker."""
    if given.scheduler:
        with distributed.Client(given.scheduler) as client:
            yield client, given.threads or 1
        return
    dask.config.set({"distributed.scheduler.allowed-failures": DEATHS - 1})
    threads = given.threads or max(1, (os.cpu_count() or 1) // given.workers)
    with distributed.LocalCluster(
            n_workers=given.workers, threads_per_worker=1, processes=True, dashboard_address=None,
            memory_limit=given.memory_limit, silence_logs="CRITICAL") as cluster:
        with distributed.Client(cluster) as client:
            yield client, threads


def parse():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", type=pathlib.Path)
    add("-o", "--out", type=pathlib.Path, required=True, help="folder of the results")
    add("--workers", type=int, default=max(1, (os.cpu_count() or 2) // 2), help="processes here")
    add("--memory-limit", default="2GB", help="of each; one that needs more is ended")
    add("--scheduler", help="tcp://HOST:PORT of a cluster instead")
    add("--threads", type=int, default=0,
        help="of Argil in each worker; 0: cores over workers, 1 with --scheduler")
    add("--again", action="store_true", help="tries what failed before once more")
    add("--unit", choices=("mm", "cm", "m", "in"), help="of files that state none")
    add("--wall-mm", type=float, default=2, help="of hollow prints; 0: solid")
    add("--drain-mm", type=float, default=1.5, help="radius of the drain at the lowest place")
    add("--voxel-mm", type=float, default=0, help="0: by --resolution")
    add("--resolution", type=int, default=200, help="voxels along the longest side")
    add("--max-error-mm", type=float, default=0, help="allows fewer triangles; 0: all")
    add("--printer", type=pathlib.Path, help="profile to check against (docs/printing.md)")
    add("--allow-loss", action="store_true", help="keeps repairs that lost or guessed much")
    given = parser.parse_args()
    if given.workers < 1 or given.threads < 0:
        parser.error("--workers must be 1 or more and --threads 0 or more")
    if not given.folder.is_dir():
        parser.error(f"'{given.folder}' is no folder")
    if given.printer and not given.printer.is_file():
        parser.error(f"there is no profile '{given.printer}'")
    return given


def kept(files, out, options, again):
    """Records of earlier runs that still hold; of what failed only where it is not to be tried again."""
    records = {}
    for file in files:
        record = done_before(file, out, options)
        if record and again and record["status"] == "failed":
            record_of(file, out).unlink()
        elif record:
            records[file] = record
    return records


def main():
    given = parse()
    out = given.out.resolve()
    (out / "records").mkdir(parents=True, exist_ok=True)
    options = {key: getattr(given, key) for key in ("unit", "wall_mm", "drain_mm", "voxel_mm",
                                                    "resolution", "max_error_mm", "allow_loss")}
    options["printer"] = str(given.printer.resolve()) if given.printer else ""
    options["printer_hash"] = content_hash(given.printer) if given.printer else ""
    files = sorted(f for f in given.folder.resolve().iterdir()
                   if f.suffix.lower() in ENDINGS and not f.is_dir())
    records = kept(files, out, options, given.again)
    todo = [file for file in files if file not in records]
    print(f"{len(files)} meshes, {len(records)} of them done before", flush=True)
    interrupted = False
    try:
        if todo:
            with connected(given) as (client, threads):
                for file, record in run(client, todo, out, options, threads):
                    records[file] = record
                    print(f"{len(records)}/{len(files)} {file.name}: {record['status']}"
                          f"{': ' if record['message'] else ''}{record['message']}", flush=True)
    except KeyboardInterrupt:
        interrupted = True
    write_report(out, [records[file] for file in files if file in records], len(files))
    failed = sum(record["status"] == "failed" for record in records.values())
    print(f"{len(records)} of {len(files)} done, {failed} failed: {out / 'report.html'}")
    return 130 if interrupted else 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
