// How large tiles are.
#pragma once

// Side of a tile, px.
#pragma vorion choice uint TILE_SIZE
// The same downwards, where tiles are not square.
#pragma vorion choice optional uint TILE_HEIGHT

#ifndef TILE_HEIGHT
#define TILE_HEIGHT TILE_SIZE
#endif
