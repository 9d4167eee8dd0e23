/* A library in front of MPI (LD_PRELOAD) that counts, for each stage of quadloop (MPI_Pcontrol), on each rank: CPU seconds outside and inside of MPI,
   messages and bytes sent to single ranks, and collective calls with the bytes that they bring. A rank that waits uses CPU time inside of MPI only.
   At the end each rank writes MPI_COUNTS/RANK: a line "peak BYTES PARTNERS", then "STAGE WORK INSIDE MESSAGES BYTES COLLECTIVES BYTES" for each stage.

     mpicc -shared -fPIC -O2 -o mpi_counts.so mpi_counts.c */
#include <mpi.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { most_stages = 64, name_size = 64 };

struct stage {
  char name[name_size];
  double work, inside;
  long long messages, bytes, collectives, collective_bytes;
};

static struct stage stages[most_stages] = {{"other", 0, 0, 0, 0, 0, 0}};
static int stage_count = 1, current = 0, depth = 0;
static double last = 0;
static char* partners = NULL;
static int rank = 0, ranks = 1;

static double cpu_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Nested calls, of which MPI makes none through these names, would count once. */
static void enter(void) {
  if (depth++ > 0) return;
  const double now = cpu_seconds();
  stages[current].work += now - last;
  last = now;
}
static void leave(void) {
  if (--depth > 0) return;
  const double now = cpu_seconds();
  stages[current].inside += now - last;
  last = now;
}

/* `name` has name_size bytes. */
static void select_stage(const char* name) {
  const double now = cpu_seconds();
  stages[current].work += now - last;
  last = now;
  for (current = 0; current < stage_count; ++current)
    if (strcmp(stages[current].name, name) == 0) return;
  if (stage_count == most_stages) {
    current = 0;
    return;
  }
  memcpy(stages[stage_count].name, name, name_size);
  current = stage_count++;
}

static long long size_of(MPI_Datatype type, long long count) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return size * count;
}
static void sent(long long bytes, int to) {
  ++stages[current].messages;
  stages[current].bytes += bytes;
  if (to >= 0 && to < ranks && to != rank) partners[to] = 1;
}
static void collective(long long bytes) {
  ++stages[current].collectives;
  stages[current].collective_bytes += bytes;
}
static int size_in(MPI_Comm comm) {
  int size = 1;
  PMPI_Comm_size(comm, &size);
  return size;
}

int MPI_Pcontrol(const int level, ...) {
  va_list rest;
  va_start(rest, level);
  char name[name_size] = "other";
  if (level == 1) {
    strncpy(name, va_arg(rest, const char*), name_size - 1);
    for (char* c = name; *c != '\0'; ++c)
      if (*c == ' ') *c = '_';
  }
  va_end(rest);
  select_stage(name);
  return MPI_SUCCESS;
}

static void begin(void) {
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  partners = calloc((size_t)ranks, 1);
  last = cpu_seconds();
}
int MPI_Init(int* argc, char*** argv) {
  const int result = PMPI_Init(argc, argv);
  begin();
  return result;
}

static long long peak_bytes(void) {
  char line[256];
  long long kilobytes = 0;
  FILE* status = fopen("/proc/self/status", "r");
  while (status != NULL && fgets(line, sizeof line, status) != NULL) sscanf(line, "VmHWM: %lld", &kilobytes);
  if (status != NULL) fclose(status);
  return kilobytes * 1024;
}

int MPI_Finalize(void) {
  enter();
  const char* folder = getenv("MPI_COUNTS");
  char path[4096];
  snprintf(path, sizeof path, "%s/%d", folder == NULL ? "." : folder, rank);
  FILE* file = fopen(path, "w");
  if (file != NULL) {
    int others = 0;
    for (int r = 0; r < ranks; ++r) others += partners[r];
    fprintf(file, "peak %lld %d\n", peak_bytes(), others);
    for (const struct stage* s = stages; s < stages + stage_count; ++s)
      fprintf(file, "%s %.6f %.6f %lld %lld %lld %lld\n", s->name, s->work, s->inside, s->messages, s->bytes, s->collectives, s->collective_bytes);
    fclose(file);
  }
  return PMPI_Finalize();
}

#define INSIDE(call)          \
  enter();                    \
  const int result = P##call; \
  leave();                    \
  return result

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  sent(size_of(type, count), to);
  INSIDE(MPI_Send(data, count, type, to, tag, comm));
}
int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  sent(size_of(type, count), to);
  INSIDE(MPI_Isend(data, count, type, to, tag, comm, request));
}
int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  INSIDE(MPI_Recv(data, count, type, from, tag, comm, status));
}
int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request) {
  INSIDE(MPI_Irecv(data, count, type, from, tag, comm, request));
}
int MPI_Wait(MPI_Request* request, MPI_Status* status) { INSIDE(MPI_Wait(request, status)); }
int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) { INSIDE(MPI_Waitall(count, requests, statuses)); }
int MPI_Waitsome(int in, MPI_Request* requests, int* out, int* which, MPI_Status* statuses) {
  INSIDE(MPI_Waitsome(in, requests, out, which, statuses));
}
int MPI_Test(MPI_Request* request, int* flag, MPI_Status* status) { INSIDE(MPI_Test(request, flag, status)); }
int MPI_Probe(int from, int tag, MPI_Comm comm, MPI_Status* status) { INSIDE(MPI_Probe(from, tag, comm, status)); }
int MPI_Iprobe(int from, int tag, MPI_Comm comm, int* flag, MPI_Status* status) { INSIDE(MPI_Iprobe(from, tag, comm, flag, status)); }
int MPI_Barrier(MPI_Comm comm) {
  collective(0);
  INSIDE(MPI_Barrier(comm));
}
int MPI_Ibarrier(MPI_Comm comm, MPI_Request* request) {
  collective(0);
  INSIDE(MPI_Ibarrier(comm, request));
}
int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  collective(size_of(type, count));
  INSIDE(MPI_Bcast(data, count, type, root, comm));
}
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  collective(size_of(type, count));
  INSIDE(MPI_Allreduce(in, out, count, type, op, comm));
}
int MPI_Exscan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  collective(size_of(type, count));
  INSIDE(MPI_Exscan(in, out, count, type, op, comm));
}
int MPI_Scan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  collective(size_of(type, count));
  INSIDE(MPI_Scan(in, out, count, type, op, comm));
}
int MPI_Allgather(const void* in, int n, MPI_Datatype type, void* out, int each, MPI_Datatype of_out, MPI_Comm comm) {
  collective(size_of(of_out, each) * size_in(comm));
  INSIDE(MPI_Allgather(in, n, type, out, each, of_out, comm));
}
int MPI_Iallgather(const void* in, int n, MPI_Datatype type, void* out, int each, MPI_Datatype of_out, MPI_Comm comm, MPI_Request* request) {
  collective(size_of(of_out, each) * size_in(comm));
  INSIDE(MPI_Iallgather(in, n, type, out, each, of_out, comm, request));
}
int MPI_Allgatherv(const void* in, int n, MPI_Datatype type, void* out, const int* counts, const int* places, MPI_Datatype of_out, MPI_Comm comm) {
  long long all = 0;
  for (int r = 0; r < size_in(comm); ++r) all += counts[r];
  collective(size_of(of_out, all));
  INSIDE(MPI_Allgatherv(in, n, type, out, counts, places, of_out, comm));
}
int MPI_Gather(const void* in, int n, MPI_Datatype type, void* out, int each, MPI_Datatype of_out, int root, MPI_Comm comm) {
  collective(size_of(type, n));
  INSIDE(MPI_Gather(in, n, type, out, each, of_out, root, comm));
}
int MPI_Alltoall(const void* in, int n, MPI_Datatype type, void* out, int each, MPI_Datatype of_out, MPI_Comm comm) {
  collective(size_of(of_out, each) * size_in(comm));
  INSIDE(MPI_Alltoall(in, n, type, out, each, of_out, comm));
}
int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* copy) {
  collective(0);
  INSIDE(MPI_Comm_dup(comm, copy));
}
int MPI_Comm_split(MPI_Comm comm, int colour, int key, MPI_Comm* part) {
  collective(0);
  INSIDE(MPI_Comm_split(comm, colour, key, part));
}
int MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm* part) {
  collective(0);
  INSIDE(MPI_Comm_split_type(comm, type, key, info, part));
}
