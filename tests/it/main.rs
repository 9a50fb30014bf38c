mod world_delivery;
mod world_ticks;
