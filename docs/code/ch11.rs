fn main() {
    use glam::{DVec2, DVec3};
    use rasterproof_render::pipeline::shade::Light;
    use rasterproof_render::pipeline::texture::{Filter, Texture, Wrap};

    let light = Light { towards: DVec3::Z, ambient: 0.2, diffuse: 0.8 };
    assert_eq!(light.intensity(DVec3::Z), 1.0);
    assert_eq!(light.intensity(-DVec3::Z), 0.2, "what faces away gets the ambient light alone");

    // Halfway between normals at a right angle: 45 degrees to the light, and shorter than 1.
    let normal = (DVec3::X + DVec3::Z) / 2.0;
    assert!((light.intensity(normal) - (0.2 + 0.8 * 0.5f64.sqrt())).abs() < 1e-15);
    assert!((normal.length() - 0.5f64.sqrt()).abs() < 1e-15);

    // Two texels, black and white, side by side.
    let texture = Texture::new(2, 1, &[[0; 3], [255; 3]]).unwrap();
    let at = |t: &Texture, u: f64| t.at(DVec2::new(u, 0.5)).x;
    assert_eq!([0.1, 0.49, 0.51, 1.1, -0.1].map(|u| at(&texture, u)), [0.0, 0.0, 1.0, 0.0, 1.0]);
    // The last bits of a coordinate at the border between them do not matter.
    assert_eq!(at(&texture, 0.5f64.next_down()), at(&texture, 0.5f64.next_up()));
    let smooth = texture.with(Filter::Bilinear, Wrap::Clamp);
    assert_eq!([0.25, 0.5, 0.75, 1.1].map(|u| at(&smooth, u)), [0.0, 0.5, 1.0, 1.0]);
}
