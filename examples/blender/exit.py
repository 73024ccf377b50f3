# SPDX-License-Identifier: GPL-3.0-or-later
"""The third: says goodbye and saves what Blender saw."""
import argil_session as session

session.end()
counts = session.client.counts
print(f"exit: {counts.states} states, {counts.proxies} proxies, {counts.malformed} malformed")
