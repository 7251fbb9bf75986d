/* Stands for CoreMark: prints its lines, with checksums of its own. */
#include "coremark.h"

extern volatile ee_s32 seed1_volatile, seed2_volatile, seed3_volatile;
extern volatile ee_s32 seed4_volatile;

static ee_u16 mixed(ee_u16 crc, ee_u32 data) {
  for (int bit = 0; bit < 32; ++bit, data >>= 1)
    crc = (ee_u16)(crc >> 1 ^ ((crc ^ data) & 1 ? 0xa001 : 0));
  return crc;
}

int main(void) {
  core_portable port;
  portable_init(&port, 0, 0);
  start_time();
  ee_u16 crc = mixed(0, (ee_u32)seed1_volatile);
  for (ee_s32 i = 0; i < seed4_volatile; ++i)
    crc = mixed(crc, (ee_u32)(seed2_volatile + seed3_volatile + i));
#if defined(BROKEN) && defined(__riscv_xvortex)
  crc ^= 1;
#endif
  stop_time();
  const secs_ret seconds = time_in_secs(get_time());
  ee_printf("Total ticks      : %lu\n", (unsigned long)get_time());
  ee_printf("Iterations/Sec   : %f\n", seed4_volatile / (seconds + 1e-9));
  ee_printf("Iterations       : %lu\n", (unsigned long)seed4_volatile);
  ee_printf("seedcrc          : 0x%04x\n", mixed(1, 2));
  ee_printf("[0]crclist       : 0x%04x\n", crc);
  ee_printf("[0]crcmatrix     : 0x%04x\n", mixed(crc, 1));
  ee_printf("[0]crcfinal      : 0x%04x\n", mixed(crc, 2));
  if (seconds > 0)
    ee_printf("Correct operation validated. See README.md for the rules.\n");
  portable_fini(&port);
  return 0;
}
