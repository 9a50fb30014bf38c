//! The renderers of diagnostics.
