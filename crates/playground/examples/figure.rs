//! Prints the script of the live figures, for `docs/build`.

fn main() {
    print!("{}", rasterproof_playground::figure_script());
}
