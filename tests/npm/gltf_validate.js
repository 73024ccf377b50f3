// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the errors and warnings of Khronos' validator about a GLB, a line each.
// Usage: NODE_PATH=node_modules node gltf_validate.js FILE
const fs = require('fs');
const validator = require('gltf-validator');

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[2]))).then((report) => {
  for (const message of report.issues.messages) {
    if (message.severity <= 1) console.log(`${message.code} ${message.pointer}: ${message.message}`);
  }
}, (fault) => { console.log(`NOT_READ ${fault}`); });
