//! What a plan of effects saves: planned against everything-on, side by side in one run.
//!
//! Each pair is checked to have the same bits before it is timed.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use rasterproof::effects::Effects;
use rasterproof::lineup::Drawer;
use rasterproof::pipeline::depth::DepthFormat;
use rasterproof::pipeline::target::{Antialias, Target};
use rasterproof::scene::chapters::scene;

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
    targets = effects
}
criterion_main!(benches);
