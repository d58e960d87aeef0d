/* Runs a kinematics module of LinuxCNC as it is shipped, outside LinuxCNC and without real time.
 *
 * linuxcnc_kinematics MODULE.so COORDINATES forward|inverse TYPE [PIN=VALUE ...]   with lines of nine numbers on stdin:
 * joints in the order of COORDINATES (forward), or the pose x y z a b c u v w (inverse); one line of nine numbers each out.
 * TYPE is the number of the kinematics, of those that the module can switch between.
 * The functions of HAL that a module calls are replaced: pins are doubles in a list. */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { kNumbers = 9, kPins = 64, kNameLength = 128 };

static struct {
  char name[kNameLength];
  double value[2];
} pins[kPins];
static int pin_count;

static void *new_pin(const char *format, va_list arguments) {
  if (pin_count == kPins) exit(3);
  vsnprintf(pins[pin_count].name, kNameLength, format, arguments);
  return pins[pin_count++].value;
}

#define PINS_OF(TYPE)                                                                        \
  int hal_pin_##TYPE##_newf(int direction, void **pin, int component, const char *f, ...) {  \
    va_list arguments;                                                                       \
    va_start(arguments, f);                                                                  \
    *pin = new_pin(f, arguments);                                                            \
    va_end(arguments);                                                                       \
    return 0;                                                                                \
  }                                                                                          \
  int hal_pin_##TYPE##_new(const char *name, int direction, void **pin, int component) {     \
    return hal_pin_##TYPE##_newf(direction, pin, component, "%s", name);                     \
  }
PINS_OF(float)
PINS_OF(bit)
PINS_OF(s32)
PINS_OF(u32)

int hal_init(const char *name) { return 1; }
int hal_exit(int component) { return 0; }
int hal_ready(int component) { return 0; }
int hal_set_unready(int component) { return 0; }
void *hal_malloc(long size) { return calloc(1, size); }
void rtapi_print(const char *format, ...) {}
void rtapi_print_msg(int level, const char *format, ...) {}

int rtapi_snprintf(char *text, unsigned long size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = vsnprintf(text, size, format, arguments);
  va_end(arguments);
  return length;
}

static int set_pin(const char *assignment) {
  const char *equals = strchr(assignment, '=');
  for (int i = 0; equals && i < pin_count; ++i)
    if (strlen(pins[i].name) == (size_t)(equals - assignment) &&
        !strncmp(pins[i].name, assignment, equals - assignment)) {
      pins[i].value[0] = atof(equals + 1);
      return 1;
    }
  fprintf(stderr, "no pin %s\n", assignment);
  return 0;
}

int main(int count, char **argument) {
  if (count < 5) return 2;
  void *module = dlopen(argument[1], RTLD_NOW | RTLD_GLOBAL);
  if (!module) return fprintf(stderr, "%s\n", dlerror()), 2;
  char ***coordinates = dlsym(module, "rtapi_info_address_coordinates");
  if (coordinates) **coordinates = argument[2];
  int (*start)(void) = dlsym(module, "rtapi_app_main");
  int (*type)(void) = dlsym(module, "kinematicsType");
  int (*select)(int) = dlsym(module, "kinematicsSwitch");
  int (*forward)(const double *, double *, const void *, void *) = dlsym(module, "kinematicsForward");
  int (*inverse)(const double *, double *, const void *, void *) = dlsym(module, "kinematicsInverse");
  if (start() < 0) return 2;
  if (type) type();  // some make their pins only then
  if (select && select(atoi(argument[4]))) return 2;
  for (int i = 5; i < count; ++i)
    if (!set_pin(argument[i])) return 2;

  unsigned long flags[2] = {0, 0};
  double in[16] = {0};
  int got = 0;
  while (scanf("%lf", &in[got]) == 1) {
    if (++got < kNumbers) continue;
    got = 0;
    double out[16] = {0};
    if ((strcmp(argument[3], "inverse") ? forward : inverse)(in, out, &flags[0], &flags[1])) return 4;
    for (int i = 0; i < kNumbers; ++i) printf("%.12g%c", out[i], i + 1 < kNumbers ? ' ' : '\n');
  }
  return 0;
}
