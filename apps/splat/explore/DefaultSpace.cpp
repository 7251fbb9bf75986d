#include "explore/Space.h"

namespace vorion::splat {

std::string_view defaultSpace() {
  return R"json({
  "parameters": {
    "core": {"key": "timing.core.preset", "values": ["forwarding", "vortex-2025"]},
    "clusters": {"key": "clusters", "values": [2, 4]},
    "sockets": {"key": "sockets_per_cluster", "values": [1, 4]},
    "cores": {"key": "cores_per_socket", "values": [2, 8]},
    "warps": {"key": "warps_per_core", "values": [2, 4]},
    "dcache": {"key": "timing.core.dcache_kib", "values": [16]},
    "icache": {"key": "timing.socket.icache_kib", "values": [8, 32]},
    "queue": {"key": "raster.queue_depth", "values": [2, 16]},
    "lanes-banks": {
      "choices": {
        "8-16": {"timing.raster.lanes": 8},
        "16-8": {"timing.raster.banks": 8},
        "16-32": {"timing.raster.banks": 32},
        "32-32": {"timing.raster.lanes": 32, "timing.raster.banks": 32}
      }
    },
    "stagger": {"key": "timing.raster.stagger", "values": [0, 8]},
    "overlap": {"key": "timing.raster.tile_overlap", "values": [1, 2]},
    "blocks": {"key": "timing.raster.skip_blocks", "values": [1, 2, 3]},
    "records": {"key": "timing.raster.buffer_entries", "values": [8, 64]},
    "l2": {"key": "timing.l2.kib", "values": [256, 512, 2048]},
    "mshrs": {"key": "timing.l2.mshrs", "values": [8, 64]},
    "mapping": {"key": "timing.dram.address_map", "values": ["row_bank_column", "xor"]},
    "memory": {
      "choices": {
        "on-chip": {
          "timing.link.l2_mhz": 0,
          "timing.link.to_l2_ns": 0,
          "timing.link.from_l2_ns": 0,
          "timing.link.to_l2_mbps": 0,
          "timing.link.from_l2_mbps": 0
        },
        "lpddr4-2": {
          "timing.link.l2_mhz": 0,
          "timing.link.to_l2_ns": 0,
          "timing.link.from_l2_ns": 0,
          "timing.link.to_l2_mbps": 0,
          "timing.link.from_l2_mbps": 0,
          "timing.dram.standard": "lpddr4-3200",
          "timing.dram.channels": 2
        },
        "lpddr4-8": {
          "timing.link.l2_mhz": 0,
          "timing.link.to_l2_ns": 0,
          "timing.link.from_l2_ns": 0,
          "timing.link.to_l2_mbps": 0,
          "timing.link.from_l2_mbps": 0,
          "timing.dram.standard": "lpddr4-3200",
          "timing.dram.channels": 8
        }
      }
    },
    "clock": {"key": "timing.clock_mhz", "values": [200, 400]},
    "exp": {"option": "--exp", "values": ["table"]},
    "tile": {"option": "--tile", "values": [32]},
    "pixel-unit": {"option": "--pixel-unit", "values": ["occluded:0.75"]}
  }
}
)json";
}

} // namespace vorion::splat
