//! Where the boxes of a tree stand: in layers, tidily, children in their order from the left.
//!
//! A subtree is laid out by itself and looks the same wherever it stands; a parent stands midway over its children; a
//! tree's mirror image is its mirror's image (Reingold and Tilford 1981; here by extents as in Kennedy 1996,
//! *Drawing trees*, with boxes of different widths). Packing children to the left, then to the right, and taking the
//! mean of both keeps the gaps, which are lower bounds on differences, and is symmetric.

/// A box with what stands under it; sizes in px.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// How wide it is.
    pub width: f64,
    /// How high it is.
    pub height: f64,
    /// What stands under it, from the left.
    pub children: Vec<Block>,
}

/// A box in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Its centre from the left, a whole number.
    pub x: f64,
    /// Its centre from the top.
    pub y: f64,
    /// How wide it is.
    pub width: f64,
    /// How high it is.
    pub height: f64,
    /// The box above, by its position in the list.
    pub parent: Option<usize>,
    /// The middle of the gap between its layer and the one below.
    pub below: f64,
}

/// Between neighbours under one parent.
const SIBLINGS: f64 = 14.0;
/// Between neighbours under different parents.
const COUSINS: f64 = 26.0;
/// A child that is this near to the middle of its parent is put there, since a line with so small a bend looks wrong.
/// Less than half of any gap, for two neighbours can both be moved.
const SNAP: f64 = 4.0;
/// Between layers.
const LAYERS: f64 = 30.0;

/// What a subtree takes up of each layer from its own down: its left and its right end, from the root's centre.
type Extent = Vec<(f64, f64)>;

/// A subtree that is laid out, by its distance from the centre of its parent.
struct Laid<'b> {
    block: &'b Block,
    offset: f64,
    children: Vec<Laid<'b>>,
}

/// Places a tree: its boxes in pre-order, and the width and the height of the whole.
pub fn place(tree: &Block) -> (Vec<Placed>, f64, f64) {
    let (laid, extent) = lay(tree);
    let left = extent.iter().map(|(left, _)| *left).fold(0.0, f64::min);
    let right = extent.iter().map(|(_, right)| *right).fold(0.0, f64::max);
    let mut heights = Vec::new();
    measure(tree, 0, &mut heights);
    let mut placed = Vec::new();
    put(&laid, -left, 0.0, &heights, None, &mut placed);
    let height = heights.iter().sum::<f64>() + LAYERS * heights.len().saturating_sub(1) as f64;
    (placed, right - left, height)
}

fn lay(block: &Block) -> (Laid<'_>, Extent) {
    let (mut children, extents): (Vec<Laid>, Vec<Extent>) = block.children.iter().map(lay).unzip();
    let offsets = offsets(&extents);
    let mut extent = vec![(-block.width / 2.0, block.width / 2.0)];
    let mut under: Extent = Vec::new();
    for ((child, offset), own) in children.iter_mut().zip(offsets).zip(&extents) {
        child.offset = offset;
        under = beside(under, own, offset);
    }
    extent.append(&mut under);
    let laid = Laid {
        block,
        offset: 0.0,
        children,
    };
    (laid, extent)
}

/// Where the children stand from the centre of their parent.
fn offsets(extents: &[Extent]) -> Vec<f64> {
    let to_the_left = packed(extents.iter().cloned());
    let mirrored = extents
        .iter()
        .rev()
        .map(|extent| extent.iter().map(|(l, r)| (-r, -l)).collect());
    let to_the_right = packed(mirrored).into_iter().rev();
    let means = to_the_left.iter().zip(to_the_right);
    means.map(|(left, right)| (left - right) / 2.0).collect()
}

/// Each subtree as far to the left as those before it allow; the first at 0.
fn packed(extents: impl Iterator<Item = Extent>) -> Vec<f64> {
    let mut taken: Extent = Vec::new();
    let mut offsets = Vec::new();
    for extent in extents {
        let gaps = std::iter::once(SIBLINGS).chain(std::iter::repeat(COUSINS));
        let needed = taken.iter().zip(&extent).zip(gaps);
        let offset = needed
            .map(|(((_, right), (left, _)), gap)| right - left + gap)
            .reduce(f64::max)
            .unwrap_or(0.0);
        taken = beside(taken, &extent, offset);
        offsets.push(offset);
    }
    offsets
}

/// Two extents together, the second moved to the right.
fn beside(taken: Extent, extent: &Extent, offset: f64) -> Extent {
    let mut both = taken;
    for (layer, (left, right)) in extent.iter().enumerate() {
        let (left, right) = (left + offset, right + offset);
        match both.get_mut(layer) {
            Some(taken) => *taken = (taken.0.min(left), taken.1.max(right)),
            None => both.push((left, right)),
        }
    }
    both
}

/// The height of each layer.
fn measure(block: &Block, layer: usize, heights: &mut Vec<f64>) {
    match heights.get_mut(layer) {
        Some(height) => *height = block.height.max(*height),
        None => heights.push(block.height),
    }
    for child in &block.children {
        measure(child, layer + 1, heights);
    }
}

/// Places a subtree whose layer begins at `top`.
fn put(
    laid: &Laid,
    x: f64,
    top: f64,
    heights: &[f64],
    parent: Option<usize>,
    placed: &mut Vec<Placed>,
) {
    let (height, lower) = heights.split_first().unwrap_or((&0.0, &[]));
    let own = placed.len();
    placed.push(Placed {
        x: x.round(),
        y: top + height / 2.0,
        width: laid.block.width,
        height: laid.block.height,
        parent,
        below: top + height + LAYERS / 2.0,
    });
    for child in &laid.children {
        let offset = if child.offset.abs() <= SNAP {
            0.0
        } else {
            child.offset
        };
        put(
            child,
            x + offset,
            top + height + LAYERS,
            lower,
            Some(own),
            placed,
        );
    }
}
