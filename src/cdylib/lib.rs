//! Links the JavaScript bindings of the library (src/wasm).

extern crate hidden_point_removal as _;

#[cfg(target_family = "wasm")]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();
