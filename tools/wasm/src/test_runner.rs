//! The `wasm-bindgen-test-runner` command, unchanged: cargo runs it on each
//! compiled test.

use std::env;

fn main() -> anyhow::Result<()> {
    wasm_bindgen_cli::wasm_bindgen_test_runner::run_cli_with_args(env::args_os())
}
