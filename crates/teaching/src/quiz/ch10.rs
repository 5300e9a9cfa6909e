//! Chapter 10: matrices.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat4, DVec3};

use super::{Solution, Text};
use rasterproof_core::angle::turn_x;
use rasterproof_faults::published::book_rotate::{Turn, published};

solvers!(first, quarter, companion, normal);

/// Scaled and then moved, or moved and then scaled: which of two products does the first.
fn first(_: &[Text]) -> Solution {
    let (s, t) = (DMat4::from_scale(DVec3::splat(2.0)), DMat4::from_translation(DVec3::X));
    let x = [t * s, s * t].map(|m| m.transform_point3(DVec3::ONE).x);
    Solution::choice(&x.map(|x| x == 3.0)).figure(x[1])
}

/// Whether two points agree but for the rounding of a sine and a cosine.
fn is_near(p: DVec3, axis: DVec3) -> bool {
    (p - axis).length() < 1e-12
}

/// Where a quarter turn about x takes the y axis, and where the book's takes it.
fn quarter(_: &[Text]) -> Solution {
    let y = turn_x(FRAC_PI_2).transform_vector3(DVec3::Y);
    let book = published(Turn::X, FRAC_PI_2, DVec3::Y);
    let all = [DVec3::Z, DVec3::NEG_Z, DVec3::X].map(|axis| is_near(y, axis));
    let name = if is_near(book, DVec3::NEG_Z) { "-z" } else { "z" };
    Solution::choice(&all).figure(name)
}

/// What the program that accompanies the book makes of the y axis by no turn at all.
fn companion(_: &[Text]) -> Solution {
    let p = published(Turn::CodeX, 0.0, DVec3::Y);
    let all = [DVec3::Y, DVec3::ZERO, DVec3::Z].map(|point| is_near(p, point));
    Solution::choice(&all)
}

/// Which matrix keeps a normal at a right angle to a direction in its surface.
fn normal(_: &[Text]) -> Solution {
    let m = DMat4::from_scale(DVec3::new(4.0, 1.0, 1.0));
    let along = m.transform_vector3(DVec3::new(1.0, -1.0, 0.0));
    let dot = |n: DMat4| along.dot(n.transform_vector3(DVec3::new(1.0, 1.0, 0.0)));
    let dots = [m, m.inverse().transpose(), m.transpose()].map(dot);
    Solution::choice(&dots.map(|dot| dot == 0.0)).figure(dots[0])
}
