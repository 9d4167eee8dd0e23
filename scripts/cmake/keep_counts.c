/* In the place of the C library's _exit(): the counts of executed lines come to the disk first. */
#include <sys/syscall.h>
#include <unistd.h>

extern void __gcov_dump(void);

void _exit(int status) {
  __gcov_dump();
  syscall(SYS_exit_group, status);
  __builtin_unreachable();
}
