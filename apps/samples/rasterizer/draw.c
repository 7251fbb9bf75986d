/* Three Gaussians, drawn by the rasterizer: a host program in C.
 *
 *   cc draw.c -lOpenCL -o draw && ./draw tiles.cl picture.ppm
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 160, HEIGHT = 120, TILE = 64, GAUSSIANS = 3 };
enum { TILES = (WIDTH + TILE - 1) / TILE * ((HEIGHT + TILE - 1) / TILE) };

/* vx_gaussian of docs/isa.md: 48 bytes. */
struct gaussian {
  cl_float mean[2];   /* centre in pixels */
  cl_float conic[3];  /* inverse covariance: xx, xy, yy */
  cl_float opacity;   /* 0 to 1 */
  cl_float color[3];  /* linear red, green, blue */
  cl_float extent[2]; /* half of the box that is drawn */
  cl_uint tag;        /* for the kernel's own use */
};

static const struct gaussian gaussians[GAUSSIANS] = {
    /* 1 / 20^2 is a standard deviation of 20 pixels; the box ends at three. */
    {{60, 50}, {1 / 400.0f, 0, 1 / 400.0f}, 0.9f, {1, 0.2f, 0.1f}, {60, 60}, 0},
    {{100, 50},
     {1 / 400.0f, 0, 1 / 400.0f},
     0.9f,
     {0.2f, 1, 0.1f},
     {60, 60},
     1},
    {{80, 80}, {1 / 900.0f, 0, 1 / 100.0f}, 0.9f, {0.1f, 0.3f, 1}, {90, 30}, 2},
};
static const cl_uint front_to_back[GAUSSIANS] = {0, 1, 2};

static void check(cl_int error, const char *what) {
  if (error != CL_SUCCESS) {
    fprintf(stderr, "draw: error: %s: OpenCL error %d\n", what, error);
    exit(1);
  }
}

/* What the compiler said. */
static void print_log(cl_program program, cl_device_id device) {
  static char text[1 << 16];
  clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof text,
                        text, NULL);
  fputs(text, stderr);
}

static char *contents(const char *name) {
  static char text[1 << 16];
  FILE *file = fopen(name, "rb");
  if (!file) {
    perror(name);
    exit(3);
  }
  text[fread(text, 1, sizeof text - 1, file)] = 0;
  fclose(file);
  return text;
}

static void write_picture(const char *name, cl_float (*pixels)[4]) {
  FILE *file = fopen(name, "wb");
  if (!file) {
    perror(name);
    exit(3);
  }
  fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT);
  for (int i = 0; i < WIDTH * HEIGHT; ++i)
    for (int c = 0; c < 3; ++c)
      fputc((int)(255 * pixels[i][c] + 0.5f), file);
  fclose(file);
}

int main(int count, char **arguments) {
  if (count != 3) {
    fprintf(stderr, "usage: draw KERNEL PICTURE\n");
    return 2;
  }
  const char *source = contents(arguments[1]);
  cl_platform_id platform;
  cl_device_id device;
  cl_int error = clGetPlatformIDs(1, &platform, NULL);
  check(error, "no platform (see splat doctor)");
  check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL),
        "no device (see splat doctor)");
  cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, &error);
  check(error, "no context");
  cl_command_queue queue = clCreateCommandQueue(context, device, 0, &error);
  check(error, "no queue");
  cl_program program =
      clCreateProgramWithSource(context, 1, &source, NULL, &error);
  check(error, "no program");
  error = clBuildProgram(program, 1, &device, "", NULL, NULL);
  if (error == CL_BUILD_PROGRAM_FAILURE)
    print_log(program, device);
  check(error, "the kernel does not compile");
  cl_kernel kernel = clCreateKernel(program, "draw", &error);
  check(error, "no kernel called draw");

  static cl_float pixels[WIDTH * HEIGHT][4];
  cl_uint statuses[TILES];
  cl_mem records =
      clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                     sizeof gaussians, (void *)gaussians, &error);
  check(error, "no buffer of Gaussians");
  cl_mem list =
      clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR,
                     sizeof front_to_back, (void *)front_to_back, &error);
  check(error, "no buffer of the list");
  cl_mem picture =
      clCreateBuffer(context, CL_MEM_WRITE_ONLY, sizeof pixels, NULL, &error);
  check(error, "no buffer of pixels");
  cl_mem status =
      clCreateBuffer(context, CL_MEM_WRITE_ONLY, sizeof statuses, NULL, &error);
  check(error, "no buffer of statuses");

  const cl_uint length = GAUSSIANS, width = WIDTH, height = HEIGHT;
  check(clSetKernelArg(kernel, 0, sizeof records, &records), "argument 0");
  check(clSetKernelArg(kernel, 1, sizeof list, &list), "argument 1");
  check(clSetKernelArg(kernel, 2, sizeof length, &length), "argument 2");
  check(clSetKernelArg(kernel, 3, sizeof width, &width), "argument 3");
  check(clSetKernelArg(kernel, 4, sizeof height, &height), "argument 4");
  check(clSetKernelArg(kernel, 5, sizeof picture, &picture), "argument 5");
  check(clSetKernelArg(kernel, 6, sizeof status, &status), "argument 6");
  /* A group of 16 work-items, which is one warp, for each tile. */
  const size_t global = 16 * TILES, local = 16;
  check(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &global, &local, 0, NULL,
                               NULL),
        "launch");
  check(clEnqueueReadBuffer(queue, picture, CL_TRUE, 0, sizeof pixels, pixels,
                            0, NULL, NULL),
        "pixels");
  check(clEnqueueReadBuffer(queue, status, CL_TRUE, 0, sizeof statuses,
                            statuses, 0, NULL, NULL),
        "statuses");

  for (int tile = 0; tile < TILES; ++tile)
    if (statuses[tile] != 0) {
      fprintf(stderr, "draw: error: tile %d ended with status %u\n", tile,
              statuses[tile]);
      return 1;
    }
  write_picture(arguments[2], pixels);
  const cl_float *middle = pixels[HEIGHT / 2 * WIDTH + WIDTH / 2];
  printf("%d tiles, all well\n", TILES);
  printf("pixel (%d, %d): red %.4f, green %.4f, blue %.4f, light from behind "
         "%.4f\n",
         WIDTH / 2, HEIGHT / 2, middle[0], middle[1], middle[2], middle[3]);
  return 0;
}
