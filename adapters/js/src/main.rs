//! The judge as a WebAssembly module, which reads and writes its standard streams.

fn main() -> std::process::ExitCode {
    rasterproof_report::hosted::main()
}
