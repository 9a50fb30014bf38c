mod world_delivery;
mod world_eval;
mod world_geometry;
mod world_ticks;
