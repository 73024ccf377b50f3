# SPDX-License-Identifier: GPL-3.0-or-later
"""The third: saves what Blender saw and says goodbye."""
import argil_session as session

session.save()
session.client.close()
counts = session.client.counts
print(f"exit: {counts.states} states, {counts.proxies} proxies, {counts.malformed} malformed")
