//! Makes the glue of a compiled module, as the command `wasm-bindgen` does with its usual options:
//! `hpr-wasm-tools MODULE FOLDER`.

use std::env;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> anyhow::Result<()> {
    let [module, folder] = &env::args().skip(1).collect::<Vec<_>>()[..] else {
        anyhow::bail!("usage: hpr-wasm-tools MODULE FOLDER");
    };
    Bindgen::new()
        // No other glue lets the package start the wasm itself, and start another copy after a trap.
        .bundler(true)?
        .typescript(true)
        .omit_default_module_path(true)
        .input_path(module)
        .generate(folder)
}
