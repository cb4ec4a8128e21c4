module.exports = { entry: "./main.js", output: { path: `${__dirname}/built` }, performance: false };
