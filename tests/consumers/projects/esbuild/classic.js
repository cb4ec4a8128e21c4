// Everything in one classic script. There is no worker, because its script would be another file.
import "../vite-inline/main.js";
