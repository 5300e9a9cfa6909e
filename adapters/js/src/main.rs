//! The judge as a WebAssembly module, which is asked through its standard streams.

fn main() -> std::process::ExitCode {
    rasterproof_report::hosted::main()
}
