/* Launches the kernel of groups.c with several shapes and checks each group. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vorion/runtime.h>

struct group {
  uint32_t runs, gx, gy, gz, core, mask;
};

static void check(vx_status status, const char *what) {
  if (status != VX_OK) {
    printf("%s: %s\n", what, vx_last_error());
    exit(1);
  }
}

static int launch(vx_device *device, vx_image *image,
                  const vx_device_info *info, const uint32_t *groups,
                  const uint32_t *local) {
  const uint32_t count = groups[0] * groups[1] * groups[2];
  const uint32_t items = local[0] * local[1] * local[2];
  const size_t records_size = (count + 1) * sizeof(struct group);
  const uint32_t zero = 0;
  uint32_t args[2], kernel;
  check(vx_mem_alloc(device, records_size, &args[0]), "alloc");
  check(vx_mem_alloc(device, 4 * (count + 1), &args[1]), "alloc");
  check(vx_fill_device(device, args[0], &zero, 4, records_size), "fill");
  check(vx_fill_device(device, args[1], &zero, 4, 4 * (count + 1)), "fill");
  check(vx_image_find_kernel(image, "visit", &kernel), "find");
  vx_launch_params params = {.work_dim = 3};
  memcpy(params.num_groups, groups, 12);
  memcpy(params.local_size, local, 12);
  check(vx_start(device, image, kernel, &params, args, sizeof(args)), "start");
  vx_result result;
  check(vx_wait(device, &result), "wait");
  if (result.outcome != VX_OUTCOME_DONE) {
    printf("outcome %d: %s\n", result.outcome, result.report);
    return 0;
  }
  struct group *records = malloc(records_size);
  uint32_t *runs = malloc(4 * (count + 1));
  check(vx_copy_from_device(device, records, args[0], records_size), "copy");
  check(vx_copy_from_device(device, runs, args[1], 4 * (count + 1)), "copy");
  const uint32_t lanes = items < info->lanes ? items : info->lanes;
  const uint32_t mask = lanes == 32 ? ~0u : (1u << lanes) - 1;
  int good = records[count].runs == 0 && runs[count] == 0;
  for (uint32_t g = 0; g < count; ++g) {
    const struct group *r = &records[g];
    const uint32_t linear = (r->gz * groups[1] + r->gy) * groups[0] + r->gx;
    if (r->runs != 1 || linear != g || r->core != g % info->cores ||
        r->mask != mask || runs[g] != items) {
      printf("group %u: %u runs, coordinates %u %u %u, core %u, mask %x, "
             "%u items\n",
             g, r->runs, r->gx, r->gy, r->gz, r->core, r->mask, runs[g]);
      good = 0;
    }
  }
  free(records);
  free(runs);
  check(vx_mem_free(device, args[0]), "free");
  check(vx_mem_free(device, args[1]), "free");
  return good;
}

int main(int argc, char **argv) {
  static const uint32_t shapes[][2][3] = {
      {{1, 1, 1}, {1, 1, 1}},   {{8, 1, 1}, {7, 1, 1}},
      {{9, 1, 1}, {16, 1, 1}},  {{3, 5, 1}, {17, 1, 1}},
      {{2, 3, 4}, {20, 1, 1}},  {{100, 1, 1}, {4, 4, 4}},
      {{1, 7, 13}, {1, 1, 64}}, {{5, 1, 2}, {1024, 1, 1}},
      {{0, 3, 3}, {8, 8, 1}},
  };
  vx_device *device;
  vx_image *image;
  vx_device_info info;
  if (argc != 2)
    return 2;
  check(vx_device_open(NULL, &device), "open");
  check(vx_device_get_info(device, &info), "info");
  check(vx_image_load_file(device, argv[1], &image), "load");
  int right = 0;
  for (size_t i = 0; i < sizeof(shapes) / sizeof(shapes[0]); ++i)
    right += launch(device, image, &info, shapes[i][0], shapes[i][1]);
  printf("%d launches right\n", right);
  check(vx_image_free(image), "free image");
  check(vx_device_close(device), "close");
  return 0;
}
