const hpr = require("hidden-point-removal");
const worker = require("hidden-point-removal/worker");
const { answer } = require("../app/answer.js");

void answer(hpr, worker).then((answered) => console.log(JSON.stringify(answered)));
