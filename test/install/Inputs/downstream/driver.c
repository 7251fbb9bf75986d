/* Runs a kernel through the driver API. usage: with-driver IMAGE */
#include <stdio.h>
#include <vorion/runtime.h>

static int failed(const char *what) {
  fprintf(stderr, "with-driver: error: %s: %s\n", what, vx_last_error());
  return 1;
}

int main(int argc, char **argv) {
  vx_device *device;
  vx_image *image;
  uint32_t kernel, out, values[64];
  if (argc != 2)
    return 2;
  if (vx_device_open("{\"global_bytes\": 8388608}", &device))
    return failed("device");
  if (vx_image_load_file(device, argv[1], &image) ||
      vx_image_find_kernel(image, "square", &kernel) ||
      vx_mem_alloc(device, sizeof values, &out))
    return failed("image");
  const vx_launch_params params = {1, {2, 1, 1}, {32, 1, 1}, {0, 0, 0}, 0, 0};
  vx_result result;
  if (vx_start(device, image, kernel, &params, &out, sizeof out) ||
      vx_wait(device, &result) || result.outcome != VX_OUTCOME_DONE ||
      vx_copy_from_device(device, values, out, sizeof values))
    return failed("run");
  printf("square of 63: %u\n", values[63]);
  vx_image_free(image);
  vx_device_close(device);
  return 0;
}
