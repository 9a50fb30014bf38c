//! How far the parts of a scene are at least, remembered along the robot's way: what is too far to matter is not measured again.

/// For each part of a scene a length that the robot has to go, at least, to touch it.
#[derive(Clone, Debug, Default)]
pub(super) struct Gaps {
    /// How far the robot has come; no point of its way is farther from here than what was added since.
    path: f64,
    /// What `path` will be, at least, where the robot touches the part. A part that is not in the list is never far.
    until: Vec<f64>,
}

/// What rounding may change, and far more.
const HAIR: f64 = 1e-9;

impl Gaps {
    /// Nothing is known of so many parts.
    pub(super) fn new(parts: usize) -> Self {
        Self {
            path: 0.0,
            until: vec![0.0; parts],
        }
    }

    /// The robot has been put somewhere else: nothing is known.
    pub(super) fn forget(&mut self) {
        self.path = 0.0;
        self.until.fill(0.0);
    }

    /// The robot has gone so far.
    #[inline(always)]
    pub(super) fn go(&mut self, length: f64) {
        // Rounding must not make the way shorter than it is.
        self.path = (self.path + length) * (1.0 + 1e-15);
    }

    /// How far the robot has come.
    #[inline(always)]
    pub(super) fn path(&self) -> f64 {
        self.path
    }

    /// What the path will be, at least, where the robot has gone `length` from here.
    #[inline(always)]
    pub(super) fn after(&self, length: f64) -> f64 {
        (self.path + length) * (1.0 - 1e-15)
    }

    /// A length that the robot has to go, at least, to touch a part; 0 where nothing is known.
    #[inline(always)]
    pub(super) fn least(&self, part: usize) -> f64 {
        let gap = self.until.get(part).map_or(0.0, |until| until - self.path);
        if gap > 0.0 { gap } else { 0.0 }
    }

    /// Whether a part is known to be farther than the root of `square`.
    #[inline(always)]
    pub(super) fn is_beyond(&self, part: usize, square: f64) -> bool {
        let gap = self.least(part);
        gap * gap > square * (1.0 + HAIR)
    }

    /// Takes in that the nearest point of a part is the root of `found` away. Whether that is farther than the root of `square`.
    #[inline(always)]
    pub(super) fn finds_beyond(&mut self, part: usize, found: f64, square: f64) -> bool {
        let beyond = found > square * (1.0 + HAIR);
        if beyond {
            let until = self.after(found.sqrt() * (1.0 - HAIR));
            if let Some(known) = self.until.get_mut(part) {
                *known = until;
            }
        }
        beyond
    }
}
