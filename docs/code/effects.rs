fn main() {
    use rasterproof_registry::engines::Drawer;
    use rasterproof_render::effects::plan::Canvas;
    use rasterproof_render::effects::{Effect, Effects, Mode};
    use rasterproof_render::pipeline::target::{Antialias, Target};
    use rasterproof_render::scene::chapters::scene;

    let panels = scene("panels", 4.0 / 3.0, 0.0).unwrap();
    let render = |effects: Effects| {
        let mut target = Target::new(640, 480, Antialias::None, Default::default()).unwrap();
        Drawer::Scanline.render(&panels, &effects, &mut target).unwrap()
    };
    let (planned, everything) = (render(Effects::PLANNED), render(Effects::ALWAYS));
    assert!(planned.picture == everything.picture, "the same bits");
    assert_eq!((planned.counters.depth_tests, planned.counters.divisions), (0, 0));
    assert_eq!(everything.counters.depth_tests, everything.counters.fragments);

    // Every decision has a reason for people.
    let depth = planned.plan.decisions.iter().find(|d| d.effect == Effect::Depth).unwrap();
    assert_eq!(depth.reason, "no bounding box of another piece meets this item's");

    // The plan was there before the frame, and draws it again.
    let mut target = Target::new(640, 480, Antialias::None, Default::default()).unwrap();
    let plan = Drawer::Scanline.plan(&panels, &Effects::PLANNED, &Canvas::of(&target)).unwrap();
    assert_eq!((&plan.frame, &plan.items), (&planned.plan.frame, &planned.plan.items));
    let again = Drawer::Scanline.execute(&plan, &panels, &mut target).unwrap();
    assert!(again.picture == planned.picture);

    // Where an effect is called for, leaving it out shows.
    let effects = Effects::PLANNED.with(Effect::Texture, Mode::Never);
    assert!(render(effects).picture != planned.picture);
    assert_eq!("planned,-texture".parse(), Ok(effects));

    // Four samples a pixel: those inside a triangle are never looked at one by one.
    let mut target = Target::new(640, 480, Antialias::Multisample4, Default::default()).unwrap();
    let smooth = Drawer::EdgeFunction.render(&panels, &Effects::PLANNED, &mut target).unwrap();
    assert!(smooth.counters.expanded < 640 * 480 / 20, "pixels whose samples are apart");
}
