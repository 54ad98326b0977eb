//! The measures of a chart: as wide as a page, or as narrow as a phone.

/// Where things lie \[pixels\].
pub(super) struct Layout {
    /// Of the drawing.
    pub(super) width: f64,
    pub(super) height: f64,
    /// Of the axes.
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// Top and bottom of the strip for unstable points.
    pub(super) strip: (f64, f64),
    /// Free along the costs before the cheapest and after the dearest.
    pub(super) room: (f64, f64),
    /// Of the first line of the legend beneath the axes.
    pub(super) legend: f64,
    /// Whether names and text have room: else they are in the surrounding page.
    pub(super) wide: bool,
}

/// Everything in one drawing.
pub(super) const WIDE: Layout = Layout {
    width: 1290.0,
    height: 906.0,
    left: 136.0,
    right: 950.0,
    top: 172.0,
    bottom: 752.0,
    strip: (122.0, 166.0),
    room: (40.0, 70.0),
    legend: 116.0,
    wide: true,
};

/// Lines, marks and the legend.
pub(super) const NARROW: Layout = Layout {
    width: 430.0,
    height: 640.0,
    left: 80.0,
    right: 420.0,
    top: 100.0,
    bottom: 480.0,
    strip: (52.0, 94.0),
    room: (16.0, 20.0),
    legend: 68.0,
    wide: false,
};
