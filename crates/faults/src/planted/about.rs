//! What each planted fault is, in a sentence, for `list` and `mutants`.

/// Names of mutants, engines first, with their faults.
const ABOUT: &[(&str, &str)] = &[
    ("inclusive-edges", "samples on any edge belong (SYSU assignment 2: <= 0)"),
    ("exclusive-edges", "samples on no edge belong (GAMES101 homework 2: > 0)"),
    ("bottom-right-rule", "bottom and right edges belong instead of top and left ones"),
    ("left-only-rule", "left edges belong, top edges do not"),
    ("sample-off-by-one-subpixel", "samples lie 1/256 px off the centre"),
    ("drops-first-row", "the first row of every triangle is lost"),
    ("doubles-span-end", "the last pixel of long spans is drawn twice"),
    ("culls-one-winding", "counter-clockwise triangles are lost, as if culled"),
    ("wraps-in-i32", "edge functions wrap around in 32 bits"),
    ("swapped-weights", "the weights of two corners are swapped"),
    ("affine-attributes", "attributes ignore w"),
    ("perspective-depth", "depth is interpolated as if it were an attribute"),
    ("values-at-corner", "values are taken at the pixel's corner, not at its centre"),
    ("values-through-f32", "values are rounded to f32 on the way"),
    ("panics-on-flat-bottom", "panics where the lowest edge is horizontal"),
    ("leaves-window", "draws one pixel outside the window"),
    ("last-edge-inclusive", "the tie rule follows the order of the corners"),
    ("truncates-towards-zero", "columns are truncated towards zero: (int) of a negative"),
    ("hole-in-long-rows", "a pixel in the middle of long spans is lost, as by a vector loop"),
    ("seam-between-tiles", "the first column of every tile but the leftmost is lost"),
    ("fills-zero-area", "a triangle of zero area covers the samples it passes through"),
    ("rejects-thin", "areas below half a pixel count as degenerate (the book's eps)"),
    ("splits-at-rounded-point", "the book's split vertex, rounded to the lattice"),
    ("steps-in-f32", "edges are stepped down row by row in f32 (the book's sx += dx)"),
    ("naive-barycentric", "values are weighted sums in the order the corners came in"),
    ("epsilon-in-denominator", "a small number keeps the division by w from failing"),
    ("clamps-inv-w", "1/w is clamped to 1"),
    ("oracle-ties-go-left", "of an oracle: right edges own their samples"),
    ("oracle-planes-in-f32", "of an oracle: sides are signs computed in f32"),
    ("oracle-affine-values", "of an oracle: values ignore w"),
    ("snap-truncates", "snapping truncates: (int)"),
    ("snap-half-away", "halves are snapped away from zero, so they depend on its side"),
    ("snap-half-up", "halves are snapped upwards"),
    ("snap-coarse", "sixteen subpixels a pixel instead of 256"),
    ("snap-saturates", "what lies outside the domain is moved to its edge, not refused"),
    ("edges-third-off-by-one", "the third edge function is evaluated a column further on"),
    ("edges-wrap-in-i32", "edge functions come out in 32 bits"),
    ("word-without-margin", "the choice of a word forgets the step past the end of the box"),
    ("word-at-most-64", "the choice of a word never takes 128 bits"),
    ("line-misses-end", "the last pixel of a line is missing (the book's DrawLine)"),
    ("line-directed-ties", "a tie is decided by the drawing direction"),
    ("line-drifts-in-f32", "the height accumulates in f32"),
    ("line-truncates", "the height is truncated instead of rounded"),
    ("line-weights-from-clip", "attributes count from the clipped start of the line"),
    ("line-draws-backwards", "pixels come out from the second end to the first"),
    ("line-steep-ties-flipped", "in steep octants a tie goes the other way"),
    ("line-four-connected", "a step along the minor axis is a pixel of its own"),
    ("line-restarts-at-border", "the part inside the window is drawn as a line of its own"),
    ("source-uniform-only", "of the cases: every family draws triangles uniformly"),
    ("source-counts", "of the cases: one depends on how many were made before"),
    ("clip-forgets-near", "clipping forgets the near plane"),
    ("clip-from-start-to-end", "a crossing depends on the direction of its edge"),
    ("clip-not-assigned", "a crossing keeps its interpolated coordinate, not the plane's"),
    ("clip-drops-last", "clipping loses the last vertex of the polygon"),
    ("clip-divides-first", "positions are divided by w before they are clipped"),
    ("cull-swapped", "culling mixes up the two windings"),
    ("cull-by-float-area", "culling asks a float area with a threshold"),
    ("effects-ignored", "every effect is paid for, whatever was asked"),
    ("effects-clear-always", "buffers are cleared, whatever was asked"),
    ("judge-forgives-a-few", "a judge: agrees where fewer than one pixel in 10,000 is wrong"),
    ("judge-gates-on-psnr", "a judge: agrees from 40 dB of peak signal to noise"),
    (
        "tile-wrapped-width",
        "lists: extents wrap around, and the widest triangles are set up in i32",
    ),
    ("tile-mask-off-by-one", "lists: the mask of columns ends one bit early"),
    ("tile-wrong-reject", "lists: a tile is rejected when none of its corner pixels is covered"),
    ("tile-tail-of-batch", "lists: what is left after the last full batch of sixteen is forgotten"),
    ("tile-wide-ones-last", "lists: of a batch, triangles that need wide words come last"),
    ("exact-plain-f64", "not snapped: the sign of E as f64 computes it, without a filter"),
    ("exact-plain-f32", "not snapped: the same in f32"),
    ("exact-filter-too-small", "not snapped: a filter a thousand times too small"),
    ("exact-plain-crossing", "not snapped: crossings as f64 computes them, no fallback"),
    ("exact-snaps-inside", "not snapped: corners are snapped to 1/256 px after all"),
    ("exact-flushes-to-zero", "not snapped: tiny coordinates count as zero"),
    ("exact-inclusive-ties", "not snapped: samples on any edge belong"),
    ("exact-bottom-right-ties", "not snapped: bottom and right edges belong"),
];

/// What is wrong with the mutant of this name; nothing where there is none.
#[must_use]
pub fn about(name: &str) -> Option<&'static str> {
    ABOUT.iter().find(|(listed, _)| *listed == name).map(|(_, about)| *about)
}

/// Every planted fault with its sentence, engines first.
pub fn all() -> impl Iterator<Item = (&'static str, &'static str)> {
    ABOUT.iter().copied()
}

/// Names of all planted faults, for the command line.
#[must_use]
pub fn names() -> Vec<&'static str> {
    all().map(|(name, _)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::Mutant;
    use crate::planted::exact::ExactMutant;

    #[test]
    fn every_mutant_is_explained_once() {
        let exact = ExactMutant::ALL.iter().map(|mutant| mutant.name());
        let mut names: Vec<_> = Mutant::all().iter().map(Mutant::name).chain(exact).collect();
        let mut listed: Vec<_> = all().map(|(name, _)| name).collect();
        names.sort_unstable();
        listed.sort_unstable();
        assert_eq!(names, listed);
    }
}
