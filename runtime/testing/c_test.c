/* The header and the library from C. */
#include <stdio.h>
#include <string.h>
#include <vorion/runtime.h>

#define EXPECT(condition)                                                      \
  do {                                                                         \
    if (!(condition)) {                                                        \
      printf("%s:%d: failed: %s (%s)\n", __FILE__, __LINE__, #condition,       \
             vx_last_error());                                                 \
      return 1;                                                                \
    }                                                                          \
  } while (0)

int main(void) {
  vx_device *device = NULL;
  EXPECT(strcmp(vx_last_error(), "") == 0);
  EXPECT(vx_device_open(NULL, NULL) == VX_ERROR_ARGUMENT);
  EXPECT(strcmp(vx_last_error(), "device is NULL") == 0);
  EXPECT(vx_device_open("{\"global_bytes\": 1048576}", &device) == VX_OK);

  vx_device_info info;
  EXPECT(vx_device_get_info(device, &info) == VX_OK);
  EXPECT(info.cores == 8 && info.lanes == 16 && info.rasterizers == 2);
  EXPECT(info.global_bytes == 1048576 && info.free_bytes == 1048576);

  uint32_t address = 0;
  const char sent[] = "to the device and back";
  char received[sizeof(sent)] = "";
  EXPECT(vx_mem_alloc(device, sizeof(sent), &address) == VX_OK);
  EXPECT(vx_copy_to_device(device, address, sent, sizeof(sent)) == VX_OK);
  EXPECT(vx_copy_from_device(device, received, address, sizeof(sent)) == VX_OK);
  EXPECT(memcmp(sent, received, sizeof(sent)) == 0);
  EXPECT(vx_mem_free(device, address) == VX_OK);
  EXPECT(vx_device_close(device) == VX_OK);
  EXPECT(vx_device_close(NULL) == VX_OK);
  return 0;
}
