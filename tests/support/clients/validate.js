// node validate.js FILE.glb: the report of the validator of glTF's makers, as JSON.
const validator = require('gltf-validator');
validator.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[2])), {maxIssues: 20})
  .then((report) => console.log(JSON.stringify(report.issues)));
