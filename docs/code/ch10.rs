fn main() {
    use glam::{DMat4, DVec3, DVec4};
    use rasterproof_render::pipeline::transform::{about, frustum, look_at};

    // Section 10.1: the matrix and the formulas of chapter 8 say the same.
    let p = frustum(-3.2, 3.2, -2.4, 2.4, 1.0, 10.0).unwrap();
    assert_eq!(p.row(3), DVec4::Z, "w is z");
    assert_eq!(p * DVec4::new(3.2, 2.4, 1.0, 1.0), DVec4::new(1.0, 1.0, -1.0, 1.0));

    // Section 10.5: the right one first. Scale, then move is not move, then scale.
    let scale = DMat4::from_scale(DVec3::splat(2.0));
    let shift = DMat4::from_translation(DVec3::X);
    assert_eq!((shift * scale).transform_point3(DVec3::ONE).x, 3.0);
    assert_eq!((scale * shift).transform_point3(DVec3::ONE).x, 4.0);

    // Section 10.6: a quarter turn about (0, 0, 4). The centre stays; z goes towards x.
    let centre = DVec3::new(0.0, 0.0, 4.0);
    let quarter = about(centre, DMat4::from_rotation_y(std::f64::consts::FRAC_PI_2));
    assert_eq!(quarter.transform_point3(centre), centre);
    let moved = quarter.transform_point3(DVec3::new(0.0, 0.0, 5.0));
    assert!((moved - DVec3::new(1.0, 0.0, 4.0)).length() < 1e-15);

    // The view: an eye behind the origin sees it ahead of itself, x still to the right.
    let view = look_at(DVec3::new(0.0, 0.0, -5.0), DVec3::ZERO, DVec3::Y).unwrap();
    assert_eq!(view.transform_point3(DVec3::X), DVec3::new(1.0, 0.0, 5.0));

    // A normal under a scaling: perpendicular only by the inverse transpose.
    let flat = DMat4::from_scale(DVec3::new(4.0, 1.0, 1.0));
    let (along, normal) = (DVec3::new(1.0, -1.0, 0.0), DVec3::new(1.0, 1.0, 0.0));
    let along = flat.transform_vector3(along);
    assert_ne!(along.dot(flat.transform_vector3(normal)), 0.0);
    assert_eq!(along.dot(flat.inverse().transpose().transform_vector3(normal)), 0.0);
}
