//! `rasterproof verify --engine vulkan:0`: a Vulkan device on the stand; and which devices there are.
//!
//! A device is judged by the judge of programs and by rules of its specification. Its name is `vulkan:` with its number in the
//! loader's list, or a word of its name or driver.

use rasterproof_host::output::Output;
use rasterproof_vulkan::device::find;
use rasterproof_vulkan::gpu::campaign;
use rasterproof_vulkan::gpu::choice::OnLadder;
use rasterproof_vulkan::gpu::engine::{Gpu, PREFIX};
use rasterproof_vulkan::gpu::look;
use rasterproof_vulkan::gpu::plant::Plant;
use rasterproof_vulkan::gpu::text;

use super::page::{Shown, show};
use super::progress::Progress;
use super::{InputError, Status, Streams, exit, program, usage};
use rasterproof_core::frame::Coverage;
use rasterproof_core::grid::PixelRect;
use rasterproof_core::triangle::Corners;
use rasterproof_judge::Options;
use rasterproof_precision::cost::ExternalChoice;
use rasterproof_report::table::Table;

/// Cases of each family where nothing is said.
const CASES: u64 = 1000;

/// The words that all commands begin with.
fn command(engine: &str, seed: u64) -> String {
    let program = program();
    // cargo compiles devices only where they are asked for.
    let program = match program.strip_suffix(" --") {
        Some(cargo) => format!("{cargo} --features vulkan --"),
        None => program,
    };
    let seed = match seed {
        seed if seed == Options::default().seed => String::new(),
        seed => format!(" --seed {seed}"),
    };
    format!("{program} verify --engine {engine}{seed}")
}

/// Judges a device, `vulkan:0`, by so many cases of each family, where they are said.
pub fn verify(
    engine: &str,
    (options, cases): (Options, Option<u64>),
    (shown, page): (Shown, Option<Output>),
    streams: &mut Streams<'_>,
) -> Status {
    let gpu = Gpu::named(engine)?;
    // A run with a time limit has no number of cases, so the time decides.
    let limited = options.time_limit.is_some();
    let cases = cases.unwrap_or(if limited { u64::MAX / 4 } else { CASES });
    let options = options.cases(cases);
    let families = campaign::families(&options.families).len() as u64;
    if families == 0 {
        return Err(usage(
            "a device is asked families of triangles within f32: not lines, far, w-extreme or stages",
        ));
    }
    let total = (!limited).then(|| families.saturating_mul(cases));
    let bar = Progress::new(streams.progress, "cases", total);
    let stand = campaign::judge(gpu, &options, &|cases| bar.done(cases));
    drop(bar);
    if stand.verdict.families.is_empty() {
        return Err(usage("no case was judged: the device does not draw what these families hold"));
    }
    // The command repeats as many cases as there was time for.
    let judged = stand.verdict.families.iter().map(|row| row.cases).max().unwrap_or(0);
    let cases = if limited { judged } else { cases };
    let command = command(engine, options.seed);
    let families: String = options.families.iter().map(|f| format!(" --family {f}")).collect();
    let case = options.only.map(|case| format!(" --case {case}")).unwrap_or_default();
    let all = format!("{command}{families}{case} --cases {cases}");
    let repeat = |family: &str, index: u64| format!("{command} --family {family} --case {index}");
    let report = text::report(&stand, &all, &repeat);
    show(report, shown, page, exit::of(stand.agrees()), streams)
}

/// The hits of triangles in a window as a device draws them.
pub fn coverage(engine: &str, list: &[Corners], window: PixelRect) -> Result<Coverage, InputError> {
    Ok(look::coverage(&mut Gpu::named(engine)?, list, window)?)
}

/// A device beside the choices that `cost` measures.
pub fn external_choice(engine: &str) -> Result<Box<dyn ExternalChoice>, InputError> {
    Ok(Box::new(OnLadder::new(engine)?))
}

/// The devices that there are, or why there are none.
pub fn listed() -> [Table; 2] {
    let found = find::list();
    // The reasons why there are none have several lines, each of which is a note.
    let (devices, notes) = match &found {
        Ok(all) => (&all[..], Vec::new()),
        Err(error) => {
            (&[][..], error.to_string().lines().map(|line| line.trim().to_owned()).collect())
        }
    };
    let about: Vec<_> = devices.iter().map(|device| text::device(&device.about)).collect();
    let named = devices.iter().map(|device| format!("{PREFIX}{}", device.number));
    let title = "Vulkan devices (rasterproof verify --engine NAME)";
    let devices = super::listed(title, named.zip(about.iter().map(String::as_str)));
    let title = "Faults to plant in a device (rasterproof verify --engine NAME+FAULT)";
    let faults = Table::of_notes(title, vec![Plant::ALL.map(Plant::name).join(" ")]);
    [devices.noted(notes), faults]
}
