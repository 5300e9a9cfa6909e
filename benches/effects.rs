//! What a plan of effects saves: planned against everything-on, side by side in one run.
//!
//! Each pair is checked to have the same bits before it is timed.

use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use rasterproof::effects::Effects;
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::depth::DepthFormat;
use rasterproof::pipeline::target::{Antialias, Target};
use rasterproof::scene::chapters::scene;
use rasterproof::scene::random;

fn effects(c: &mut Criterion) {
    let cases = [
        ("panels", Antialias::None),
        ("facets", Antialias::None),
        ("tilted", Antialias::None),
        ("sphere", Antialias::None),
        ("facets", Antialias::Supersample(4)),
        ("panels", Antialias::Multisample4),
        ("everything", Antialias::None),
    ];
    for (name, antialias) in cases {
        let scene = scene(name, 4.0 / 3.0, 0.0).expect("a scene of the catalogue");
        let mut target =
            Target::new(640, 480, antialias, DepthFormat::Unorm32).expect("a usual size");
        let mut group = c.benchmark_group(format!("effects/{name}-{}", antialias.samples()));
        for drawer in Drawer::ALL {
            let mut draw = |effects| drawer.render(&scene, effects, &mut target).expect("it draws");
            let (all, planned) = (draw(&Effects::ALWAYS), draw(&Effects::PLANNED));
            assert!(all.picture == planned.picture, "{name} differs");
            for (kind, effects) in [("all", Effects::ALWAYS), ("planned", Effects::PLANNED)] {
                group.bench_function(format!("{}/{kind}", drawer.name()), |b| {
                    b.iter(|| drawer.render(&scene, &effects, &mut target));
                });
            }
        }
    }
}

/// Prints how the times of planned frames compare over random scenes, and of which scene planning
/// saves least: the smallest of seven rounds each.
fn never_slower(_: &mut Criterion) {
    const SCENES: u64 = 60;
    let smoothings = [
        Antialias::None,
        Antialias::Multisample4,
        Antialias::Supersample(2),
        Antialias::Supersample(4),
    ];
    for (antialias, drawer) in smoothings.iter().flat_map(|a| Drawer::ALL.map(|d| (*a, d))) {
        let mut target =
            Target::new(320, 240, antialias, DepthFormat::Unorm32).expect("a usual size");
        let (mut sums, mut worst) = ([0.0; 2], (0.0, 0));
        for index in 0..SCENES {
            let scene = random::scene(7, index);
            let mut smallest = [f64::INFINITY; 2];
            for _ in 0..7 {
                for (time, effects) in smallest.iter_mut().zip([Effects::ALWAYS, Effects::PLANNED])
                {
                    let start = Instant::now();
                    std::hint::black_box(drawer.render(&scene, &effects, &mut target).is_ok());
                    *time = time.min(start.elapsed().as_secs_f64());
                }
            }
            let share = smallest[1] / smallest[0];
            worst = if share > worst.0 { (share, index) } else { worst };
            sums = [sums[0] + smallest[0], sums[1] + smallest[1]];
        }
        println!(
            "{SCENES} random scenes, {antialias:?}, {}: planned takes {:.2} of the time; \
             at most {:.3}, of scene {}",
            drawer.name(),
            sums[1] / sums[0],
            worst.0,
            worst.1
        );
    }
}

/// Short enough that all scenes together take about a minute.
fn short() -> Criterion {
    Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500))
}

criterion_group! {
    name = benches;
    config = short();
    targets = effects, never_slower
}
criterion_main!(benches);
