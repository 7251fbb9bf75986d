/* A process that is forked after a command was executed: the child's command
 * must fail, and the child must end. */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

static cl_context Context;
static cl_command_queue Queue;

static cl_int fill(void) {
  cl_int Status;
  cl_mem Buffer = clCreateBuffer(Context, CL_MEM_READ_WRITE, 64, NULL, &Status);
  const cl_int One = 1;
  cl_int Read = 0;
  Status = clEnqueueFillBuffer(Queue, Buffer, &One, sizeof(One), 0, 64, 0, NULL,
                               NULL);
  if (Status == CL_SUCCESS)
    Status = clEnqueueReadBuffer(Queue, Buffer, CL_TRUE, 0, sizeof(Read), &Read,
                                 0, NULL, NULL);
  clReleaseMemObject(Buffer);
  return Status == CL_SUCCESS && Read != 1 ? -9999 : Status;
}

int main(void) {
  cl_platform_id Platform;
  cl_device_id Device;
  clGetPlatformIDs(1, &Platform, NULL);
  clGetDeviceIDs(Platform, CL_DEVICE_TYPE_ALL, 1, &Device, NULL);
  Context = clCreateContext(NULL, 1, &Device, NULL, NULL, NULL);
  Queue = clCreateCommandQueue(Context, Device, 0, NULL);
  printf("parent: %d\n", fill());
  fflush(stdout);
  const pid_t Child = fork();
  if (Child == 0) {
    const cl_int Status = fill();
    printf("child: %s\n", Status == CL_SUCCESS ? "success" : "failed");
    printf("finish: %d\n", clFinish(Queue));
    clReleaseCommandQueue(Queue);
    clReleaseContext(Context);
    return 7;
  }
  int Ended = 0;
  waitpid(Child, &Ended, 0);
  printf("ended with %d\n", WEXITSTATUS(Ended));
  printf("parent: %d\n", fill());
  return 0;
}
