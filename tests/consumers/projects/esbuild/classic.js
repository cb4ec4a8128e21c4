// Everything in one script that is no module: without a worker, whose script would be another file.
import "../vite-inline/main.js";
