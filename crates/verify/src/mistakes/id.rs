//! Which mistakes are looked for by others than the judge.

rasterproof_core::named! {
    /// A mistake that somebody looks for, such as the course for what a student believes. Its name is what is said of it, after 'it'.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MistakeId {
        Affine = "interpolates attributes linearly on the screen and ignores w (affine)",
        NotDividedBack = "interpolates a/w and forgets to divide by the interpolated 1/w",
        WeightsByW = "weights the corners by w where 1/w is right",
        TransposedMatrix = "takes the weights from the transposed matrix",
        ExchangedWeights = "exchanges the weights of the second and the third corner of counterclockwise triangles",
        UpperLeftValues = "computes right values, at the upper left corner of the pixel",
        DepthNotDivided = "does not divide depth by the area",
        DepthNotDividedBySign = "does not divide depth by the signed area",
        UndividedDepthsCompared = "compares depths that are not divided by the area of their triangle",
        DepthDividedTwice = "divides depth by w once more",
        DepthInPerspective = "interpolates depth as an attribute, with the correction for perspective",
        LastShown = "shows the triangle that was drawn last, without a test of depth",
        FarthestShown = "shows the farthest triangle",
        SortedByMeanDepth = "sorts whole triangles by the mean depth of their corners (painter's algorithm)",
        NotClipped = "does not clip",
        CutTrianglesDropped = "drops a triangle with any corner behind the near plane",
        ClippedAtZero = "clips to z >= 0, as Direct3D and Vulkan have it",
        SamplesAtCentre = "tests all four samples at the centre",
        SamplesInSquare = "tests all four samples two by two, at quarters of the pixel",
        SamplesBackwards = "numbers the samples 3, 2, 1, 0",
    }
}

impl MistakeId {
    /// The mistake of which this is said, if it is one of these.
    #[must_use]
    pub fn of(does: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|id| id.name() == does)
    }
}
