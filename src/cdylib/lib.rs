//! Links the JavaScript bindings of the library (src/wasm).

extern crate hidden_point_removal as _;
