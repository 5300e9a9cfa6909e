fn main() {
    use rasterproof_precision::cost::{CostOptions, Ladder, measure};

    // Without times, a board takes a moment and depends on the seed alone.
    let board =
        measure(Ladder::Lines, &CostOptions { seed: 1, quick: true, timing: None }, &|_, _| ());
    let choice = |name| board.choices.iter().position(|choice| choice.name == name).unwrap();
    let large = board.columns.iter().position(|column| column.name == "large").unwrap();
    assert_eq!(board.error(choice("Bresenham"), large, 0), Some(0.0));
    assert!(board.error(choice("f64 DDA"), large, 0) > Some(0.0));
}
