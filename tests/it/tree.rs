//! Trees from policies, and what is proved of them.

mod small_delivery;
