# SPDX-License-Identifier: GPL-3.0-or-later
"""A simulator with the servo in its own process."""
import time

import numpy as np
import pytest

import argil
from argil import bridge
from argil.local_bridge import LocalClient


def answer_floor(client, seconds):
    """A floor at y = 0 as a simulator answers it; the states it saw."""
    states = []
    end = time.monotonic() + seconds
    while time.monotonic() < end and client.wait(0.5):
        state = client.state
        client.answer(bridge.proxy_at(state, client.welcome, (state.position_mm[0], 0.0, state.position_mm[2]),
                                      (0.0, 1.0, 0.0), state.position_mm[1]))
        states.append(state)
        time.sleep(1.0 / client.rate_hz)
    return states


@pytest.mark.parametrize("law", ["plane", "indirect"])
def test_a_hand_presses_a_floor_and_is_held(law):
    client = LocalClient(200.0, law=law, motion=[[0, 0, 5, 0, 0], [0.5, 0, 0, 0, 0], [0.8, 0, 0, 0, 3]])
    assert client.connect(5.0)
    assert bridge.LAWS[client.welcome.law] == law
    states = answer_floor(client, 3.0)
    client.close()
    held = np.array([state.force_n for state in states[-100:]])
    depth = -np.array([state.position_mm[1] for state in states[-100:]])
    assert np.abs(held[:, 1] - 3.0).max() < 0.3  # what the hand presses, less the device's friction
    assert np.abs(depth - 2.0).max() < 0.3  # 3 N of 1500 N/m
    assert np.abs(held[:, [0, 2]]).max() < 1e-6
    assert client.report["ticks"] > 2000 and client.report["proxies"] > 200
    assert client.report["malformed"] == 0


def test_a_simulator_that_falls_silent_is_not_felt_and_may_come_back():
    client = LocalClient(100.0, motion=[[0, 0, 0, 0, 0], [0.1, 0, 0, 0, 3]])
    assert client.connect(5.0)
    answer_floor(client, 1.0)
    time.sleep(0.6)
    client.receive()
    assert np.abs(client.state.force_n).max() == 0.0
    assert client.connect(5.0)
    assert len(answer_floor(client, 0.5)) > 20
    client.close()


@pytest.mark.parametrize("wrong, words", [
    ({"law": "clay"}, "must be one of direct, indirect, plane"),
    ({"device": "mouse"}, "must be sim or falcon"),
    ({"hand": "robot"}, "must be one of push, light, arm, firm"),
    ({"stiffness_n_per_m": 7000.0}, "breaks k T < 2 b"),
    ({"stiffness_n_per_m": float("nan")}, "stiffness_n_per_m"),
    ({"motion": [[0, 0, 0, 0]]}, "shape"),
    ({"motion": np.zeros((0, 5))}, "no row"),
    ({"motion": [[1, 0, 0, 0, 0], [0, 0, 0, 0, 0]]}, "ascend"),
])
def test_what_is_wrong_is_named(wrong, words):
    with pytest.raises(argil.BadInput, match=words):
        LocalClient(200.0, **wrong)
    with pytest.raises(ValueError, match="rate"):
        LocalClient(1.0)


def test_malformed_datagrams_are_counted_and_dropped():
    client = LocalClient(100.0)
    assert client.connect(5.0)
    assert not client._local.put(b"")
    assert not client._local.put(b"x" * 500)
    assert client._local.put(b"nonsense")
    assert len(answer_floor(client, 0.3)) > 5
    client.close()
    assert client.report["malformed"] == 1
