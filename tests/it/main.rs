mod world_delivery;
mod world_eval;
mod world_geometry;
mod world_motion;
mod world_ticks;
