# SPDX-License-Identifier: GPL-3.0-or-later
"""The second: the coupling loop. Each frame feels where the handle is and answers with the proxy.

Ends when the bridge says goodbye or falls silent. In lockstep it answers what it is asked; in real
time it keeps its rate.
"""
import time

import argil_session as session

client = session.client
due = time.monotonic()
try:
    while client.wait(session.options.silence):
        session.step()
        if not client.is_lockstep:
            due = max(due + 1.0 / client.rate_hz, time.monotonic() - 0.1)
            time.sleep(max(0.0, due - time.monotonic()))
except BaseException:
    session.end()  # exit.py will not run
    raise
