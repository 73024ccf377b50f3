#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A simulator without Blender: a floor (y < 0) or a ball under y = 0, for trying `argil bridge`. Of
`argil bridge --clay` it takes the clay and says what it got; of `argil bridge --scene` it only has the
handle.

Usage: stand_in.py [--host A.B.C.D] [--port N] [--key FILE] [--rate HZ] [--shape floor|ball]
                   [--ball-mm R] [--seconds S] [--save CLAY.stl]
Ends when the bridge says goodbye, or after --seconds of silence. In lockstep it answers what it is
asked; in real time it sends at its rate. With --think-ms it takes longer over each answer.
"""
import argparse
import math
import sys
import time

import argil_bridge as bridge
import argil_clay


def nearest_floor(place, _radius):
    return (place[0], 0.0, place[2]), (0.0, 1.0, 0.0), place[1]


def nearest_ball(place, radius):
    centre = (0.0, -radius, 0.0)
    out = bridge.add(place, bridge.scaled(centre, -1.0))
    size = math.sqrt(bridge.dot(out, out))
    normal = bridge.scaled(out, 1.0 / size) if size > 0.0 else (0.0, 1.0, 0.0)
    return bridge.add(centre, bridge.scaled(normal, radius)), normal, size - radius


SHAPES = {"floor": nearest_floor, "ball": nearest_ball}


class Shape:
    """Something to touch."""

    note = ""

    def __init__(self, nearest, radius):
        self.nearest, self.radius = nearest, radius

    def answer(self, state, welcome):
        point, normal, distance = self.nearest(state.position_mm, self.radius)
        return bridge.proxy_at(state, welcome, point, normal, distance)


def run(client, contact, think_s, silence_s):
    """Answers until the bridge ends or falls silent."""
    next_frame = time.monotonic()
    told = ""
    while not client.has_ended:
        if not client.wait(silence_s):
            return
        if not client.is_lockstep:
            next_frame = max(next_frame + 1.0 / client.rate_hz, time.monotonic() - 1.0)
        if think_s > 0.0:
            time.sleep(think_s)
        client.answer(contact.answer(client.state, client.welcome))
        if contact.note != told:
            told = contact.note
            print(f"stand_in: {told or 'strokes are kept again'}", flush=True)
        if not client.is_lockstep:
            time.sleep(max(0.0, next_frame - time.monotonic()))


def tell(contact, file):
    """Of the clay, once the bridge has sent all of it."""
    contact.thread.wait_for_end(10.0)
    contact.thread.end()
    triangles = contact.thread.clay.corners()
    if file:
        argil_clay.write_stl(file, triangles)
    print("stand_in: " + contact.report(triangles))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=bridge.USUAL_PORT)
    parser.add_argument("--key", help="the bridge's key file, where it is not in its usual place")
    parser.add_argument("--rate", type=float, default=60.0)
    parser.add_argument("--shape", choices=sorted(SHAPES), default="floor")
    parser.add_argument("--ball-mm", type=float, default=40.0)
    parser.add_argument("--think-ms", type=float, default=0.0)
    parser.add_argument("--seconds", type=float, default=30.0, help="of silence until it gives up")
    parser.add_argument("--save", help="an STL of the clay as it was at the end")
    options = parser.parse_args()
    clay = None
    try:
        client = bridge.Client(options.rate, options.port, options.host, options.key)
    except ValueError as error:
        sys.exit(f"stand_in: {error}")
    try:
        if not client.connect(options.seconds):
            sys.exit(f"stand_in: {client.unwelcome()}")
        law = bridge.LAWS[client.welcome.law]
        print(f"stand_in: coupled at {client.rate_hz:g} Hz with the law {law}", flush=True)
        if law == "clay":
            contact = clay = argil_clay.ClayContact(client)
        elif law == "scene":
            contact = bridge.HandleContact()
        else:
            contact = Shape(SHAPES[options.shape], options.ball_mm)
        run(client, contact, options.think_ms / 1000.0, options.seconds)
    except bridge.Refused as refusal:
        sys.exit(f"stand_in: {refusal}")
    except KeyboardInterrupt:  # as good an end as another, and no time to wait for the rest
        if clay is not None:
            clay.thread.end()
    finally:
        client.close()
    if clay is not None:
        tell(clay, options.save)
    print(f"stand_in: {client.counts.states} states, {client.counts.proxies} proxies, "
          f"{client.counts.malformed} malformed")


if __name__ == "__main__":
    main()
