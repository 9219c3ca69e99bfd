/* The analysis of benches/large by CHOLMOD, BLAS and ARPACK, on the same matrices and in one thread.
 *
 *     cargo bench --bench large -- --write FOLDER --cholmod cc 1k 10k
 *
 * compiles it and starts it for every wing. By hand:
 *
 *     cc -O3 -march=native -I/usr/include/suitesparse -o cholmod_wing benches/cholmod_wing.c -lcholmod -larpack -lopenblas -lm
 *     OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 ./cholmod_wing FOLDER/1k
 *
 * It prints rows of paper/costs.csv. The factorization alone is timed in an order by METIS found before; the modes of the whole model
 * with assembly and ordering, which is CHOLMOD's own choice there, and not counted.
 */

#include <arpack/arpack.h>
#include <cblas.h>
#include <cholmod.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { KRYLOV = 41, BATCH = 64, MOST_DOF = 12, MOST_WIDTH = 64 };

static void fail(const char *what) {
    fprintf(stderr, "cholmod_wing: %s\n", what);
    exit(1);
}

static void *memory(size_t count, size_t size) {
    void *new = calloc(count, size);
    return new ? new : (fail("out of memory"), NULL);
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}

/* The least seconds of some repeats: two at least, for the first touches new memory. */
static double least(void (*work)(void)) {
    double total = 0.0, least = INFINITY;
    for (int repeats = 0; repeats < 20 && (total < 0.4 || repeats < 2) && total < 30.0; repeats++) {
        double start = now();
        work();
        double took = now() - start;
        total += took;
        least = fmin(least, took);
    }
    return least;
}

static void forget_most_memory(void) {
    FILE *file = fopen("/proc/self/clear_refs", "w");
    if (!file || fputs("5", file) < 0 || fclose(file))
        fail("/proc/self/clear_refs");
}

/* The most memory that this process has held since then, MB. */
static double most_memory(void) {
    char line[256];
    double held = 0.0;
    FILE *status = fopen("/proc/self/status", "r");
    while (status && fgets(line, sizeof line, status))
        sscanf(line, "VmHWM: %lf", &held);
    if (status)
        fclose(status);
    return 1.024e-3 * held;
}

/* An array of eight-byte numbers in NumPy's format 1.0, last index fastest. */
typedef struct {
    int64_t shape[3];
    double *number;
    int64_t *integer;
} Array;

static Array read_array(const char *folder, const char *name) {
    char path[4096], head[65536] = {0};
    uint16_t length = 0;
    snprintf(path, sizeof path, "%s/%s.npy", folder, name);
    FILE *file = fopen(path, "rb");
    if (!file || fread(head, 1, 8, file) != 8 || fread(&length, 2, 1, file) != 1 || fread(head, 1, length, file) != length)
        fail(path);
    Array array = {{1, 1, 1}, NULL, NULL};
    const char *shape = strstr(head, "'shape': (") + strlen("'shape': (");
    sscanf(shape, "%ld, %ld, %ld", &array.shape[0], &array.shape[1], &array.shape[2]);
    size_t count = array.shape[0] * array.shape[1] * array.shape[2];
    array.number = memory(count, 8);
    array.integer = (int64_t *)array.number;
    if (fread(array.number, 8, count, file) != count)
        fail(path);
    fclose(file);
    return array;
}

/* Elements of a kind, sorted by group, and where each entry of their lower triangles goes in the stiffness, or -1. */
typedef struct {
    int64_t count, size, *dof, *group, *order;
    int *place;
    double *unit, *gage;
} Elements;

static Elements read_elements(const char *folder, const char *kind, int groups) {
    char name[64];
    Array arrays[4];
    const char *parts[] = {"unit", "dof", "size", "group"};
    for (int part = 0; part < 4; part++) {
        snprintf(name, sizeof name, "%s_%s", kind, parts[part]);
        arrays[part] = read_array(folder, name);
    }
    Elements of = {arrays[1].shape[0],  arrays[1].shape[1], arrays[1].integer, arrays[3].integer, NULL, NULL,
                   arrays[0].number, arrays[2].number};
    of.order = memory(of.count, sizeof *of.order);
    of.place = memory(of.count * of.size * of.size, sizeof *of.place);
    for (int64_t group = 0, next = 0; group < groups; group++)
        for (int64_t e = 0; e < of.count; e++)
            if (of.group[e] == group)
                of.order[next++] = e;
    return of;
}

static cholmod_common common;
static cholmod_sparse *stiffness, *mass;
static cholmod_factor *factor;
static Elements kinds[2];
static Array expected, expected_shares, mass_place, mass_value;
static int groups, width, count;
static double *shapes, *sums, roots[KRYLOV];

/* Row and column of an entry of the elements' matrices, if it is of the lower triangle and neither is held. */
static int is_stored(const Elements *of, int64_t at, int *row, int *column) {
    const int64_t *dof = of->dof + at / (of->size * of->size) * of->size;
    *row = dof[at / of->size % of->size];
    *column = dof[at % of->size];
    return *row >= *column && *column >= 0;
}

static int64_t entries(const Elements *of) { return of->count * of->size * of->size; }

static int compare(const void *one, const void *other) { return *(const int *)one - *(const int *)other; }

static void find_pattern(void) {
    int row, column;
    size_t most = entries(&kinds[0]) + entries(&kinds[1]);
    cholmod_triplet *triplet = cholmod_allocate_triplet(count, count, most, -1, CHOLMOD_REAL, &common);
    for (Elements *of = kinds; of < kinds + 2; of++)
        for (int64_t at = 0; at < entries(of); at++)
            if (is_stored(of, at, &row, &column)) {
                ((int *)triplet->i)[triplet->nnz] = row;
                ((int *)triplet->j)[triplet->nnz] = column;
                ((double *)triplet->x)[triplet->nnz++] = 0.0;
            }
    stiffness = cholmod_triplet_to_sparse(triplet, 0, &common);
    cholmod_free_triplet(&triplet, &common);
    cholmod_sort(stiffness, &common);
    const int *begins = stiffness->p, *rows = stiffness->i;
    for (Elements *of = kinds; of < kinds + 2; of++)
        for (int64_t at = 0; at < entries(of); at++) {
            of->place[at] = -1;
            if (is_stored(of, at, &row, &column)) {
                int length = begins[column + 1] - begins[column];
                of->place[at] = (int *)bsearch(&row, rows + begins[column], length, sizeof row, compare) - rows;
            }
        }
}

static void assemble(void) {
    double *values = stiffness->x;
    memset(values, 0, stiffness->nzmax * sizeof *values);
    for (Elements *of = kinds; of < kinds + 2; of++)
        for (int64_t at = 0, size = of->size * of->size; at < entries(of); at++)
            if (of->place[at] >= 0)
                values[of->place[at]] += of->gage[at / size] * of->unit[at];
}

static void factorize(void) {
    assemble();
    if (!cholmod_factorize(stiffness, factor, &common) || common.status != CHOLMOD_OK)
        fail("CHOLMOD finds no factor");
}

/* V_e^t K_e V_e summed by group. */
static void find_shares(void) {
    static double moved[BATCH * MOST_DOF * MOST_WIDTH], forces[BATCH * MOST_DOF * MOST_WIDTH];
    memset(sums, 0, sizeof(double) * groups * width * width);
    for (int kind = 0; kind < 2; kind++) {
        const Elements *of = &kinds[kind];
        for (int64_t first = 0, last; first < of->count; first = last) {
            int64_t size = of->size, group = of->group[of->order[first]];
            for (last = first; last < of->count && last < first + BATCH && of->group[of->order[last]] == group; last++) {
                int64_t e = of->order[last], at = (last - first) * size * width;
                for (int64_t row = 0; row < size; row++) {
                    int64_t dof = of->dof[size * e + row];
                    memcpy(moved + at + row * width, shapes + (dof < 0 ? count : dof) * width, width * sizeof(double));
                }
                memset(forces + at, 0, size * width * sizeof(double));
                for (int64_t entry = 0; entry < size * size; entry++) {
                    double stiff = of->gage[e] * of->unit[size * size * e + entry];
                    double *restrict force = forces + at + entry / size * width;
                    const double *restrict motion = moved + at + entry % size * width;
                    for (int shape = 0; shape < width; shape++)
                        force[shape] += stiff * motion[shape];
                }
            }
            cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, width, width, (last - first) * size, 1.0, moved, width, forces,
                        width, 1.0, sums + group * width * width, width);
        }
    }
}

/* The lowest modes with a factorization in CHOLMOD's own order; their shapes, a row for every degree of freedom and one of zeros. */
static void find_modes(void) {
    int ido = 0, info = 0, parameters[11] = {1, 0, 100000, 1, 0, 0, 3}, places[11], length = KRYLOV * (KRYLOV + 8);
    int chosen[KRYLOV] = {0};
    assemble();
    double *start = memory(count, 8), *basis = memory((size_t)count * KRYLOV, 8), *work = memory(3 * (size_t)count, 8);
    double *small = memory(length, 8), one[2] = {1.0, 0.0}, zero[2] = {0.0, 0.0};
    cholmod_dense in = {count, 1, count, count, NULL, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE}, out = in;
    cholmod_dense *solved = NULL, *one_space = NULL, *other_space = NULL;
    cholmod_factor *own = cholmod_analyze(stiffness, &common);
    cholmod_factorize(stiffness, own, &common);
    do {
        dsaupd_c(&ido, "G", count, "LM", width, DBL_EPSILON, start, KRYLOV, basis, count, parameters, places, work, small, length, &info);
        in.x = work + places[0] - 1, out.x = work + places[1] - 1;
        if (ido == -1 || ido == 2)
            cholmod_sdmult(mass, 0, one, zero, &in, &out, &common);
        if (ido == -1)
            in.x = out.x;
        else if (ido == 1)
            in.x = work + places[2] - 1;
        if (ido == -1 || ido == 1) {
            cholmod_solve2(CHOLMOD_A, own, &in, NULL, &solved, NULL, &one_space, &other_space, &common);
            memcpy(out.x, solved->x, sizeof(double) * count);
        }
    } while (ido != 99);
    if (info == 0)
        dseupd_c(1, "A", chosen, roots, basis, count, 0.0, "G", count, "LM", width, DBL_EPSILON, start, KRYLOV, basis, count,
                 parameters, places, work, small, length, &info);
    if (info)
        fail("ARPACK finds no modes");
    for (int dof = 0; dof < count; dof++)
        for (int shape = 0; shape < width; shape++)
            shapes[dof * (int64_t)width + shape] = basis[dof + (size_t)count * shape];
    cholmod_free_factor(&own, &common);
    cholmod_free_dense(&solved, &common), cholmod_free_dense(&one_space, &common), cholmod_free_dense(&other_space, &common);
    free(start), free(basis), free(work), free(small);
}

static void read_problem(const char *folder) {
    expected = read_array(folder, "frequencies"), expected_shares = read_array(folder, "shares");
    mass_place = read_array(folder, "mass_place"), mass_value = read_array(folder, "mass_value");
    groups = expected_shares.shape[0], width = expected.shape[0];
    kinds[0] = read_elements(folder, "rod", groups), kinds[1] = read_elements(folder, "panel", groups);
    for (Elements *of = kinds; of < kinds + 2; of++)
        for (int64_t at = 0; at < of->count * of->size; at++)
            count = of->dof[at] >= count ? of->dof[at] + 1 : count;
    if (width > MOST_WIDTH || width > KRYLOV / 2)
        fail("too many shapes");
}

/* The mass, and space for everything that is timed. */
static void prepare(void) {
    shapes = memory((count + 1) * (size_t)width, 8), sums = memory(groups * width * width, 8);
    cholmod_triplet *triplet = cholmod_allocate_triplet(count, count, mass_value.shape[0], 0, CHOLMOD_REAL, &common);
    for (size_t at = 0; at < triplet->nzmax; at++, triplet->nnz++) {
        ((int *)triplet->i)[at] = mass_place.integer[2 * at], ((int *)triplet->j)[at] = mass_place.integer[2 * at + 1];
        ((double *)triplet->x)[at] = mass_value.number[at];
    }
    mass = cholmod_triplet_to_sparse(triplet, 0, &common);
    cholmod_free_triplet(&triplet, &common);
}

/* The largest relative difference of frequencies, and of shares of the modes from those that were written. */
static double apart(void) {
    double most = 0.0;
    for (int mode = 0; mode < width; mode++) {
        most = fmax(most, fabs(sqrt(roots[mode]) / (2.0 * M_PI * expected.number[mode]) - 1.0));
        for (int group = 0; group < groups; group++) {
            double share = expected_shares.number[group * width + mode];
            most = fmax(most, fabs(sums[(group * width + mode) * width + mode] - share) / roots[mode]);
        }
    }
    return most;
}

static void print(const char *row, const char *unit, double value) { printf("%s,%s,%.6g\n", row, unit, value); }

int main(int many, char **arguments) {
    if (many != 2 || !getenv("OMP_THREAD_LIMIT") || !getenv("OPENBLAS_NUM_THREADS"))
        fail("start it with OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 and the folder of a wing");
    cholmod_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    read_problem(arguments[1]);
    find_pattern();
    double stored[2];
    for (int method = 0; method < 2; method++) {
        cholmod_free_factor(&factor, &common);
        common.nmethods = 1;
        common.method[0].ordering = method == 0 ? CHOLMOD_AMD : CHOLMOD_METIS;
        factor = cholmod_analyze(stiffness, &common);
        stored[method] = 1e-6 * common.lnz;
    }
    common.nmethods = 0;
    forget_most_memory();
    prepare();
    double factorization = least(factorize), vibration = least(find_modes), analysis = vibration + least(find_shares);
    double held = most_memory(), difference = apart();
    fprintf(stderr, "CHOLMOD, %d DOF: frequencies and shares agree to %.1e\n", count, difference);
    if (!(difference < 1e-8))
        fail("frequencies or shares are not the same");
    print("assembly and factorization by CHOLMOD", "ms", 1e3 * factorization);
    print("20 modes by CHOLMOD (not counted)", "ms", 1e3 * vibration);
    print("analysis by CHOLMOD", "ms", 1e3 * analysis);
    print("most memory of the CHOLMOD process", "MB", held);
    print("entries of the factor by METIS through CHOLMOD", "million", stored[1]);
    print("entries of the factor by AMD through CHOLMOD", "million", stored[0]);
}
