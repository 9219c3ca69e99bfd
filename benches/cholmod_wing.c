/* The analysis of benches/large by CHOLMOD, BLAS, LAPACK and ARPACK, on the same matrices and in one thread.
 *
 *     cargo bench --bench large -- --write FOLDER --cholmod cc 1k 10k
 *
 * compiles it and starts it for every wing. By hand:
 *
 *     cc -O3 -march=native -I/usr/include/suitesparse -o cholmod_wing benches/cholmod_wing.c -lcholmod -larpack -lopenblas -lm
 *     OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1 ./cholmod_wing FOLDER/1k
 *
 * It prints rows of paper/costs.csv. Ordering and pattern are made once and not timed, as in the programs that it is compared
 * with. Loads go forward through the factor alone and the shapes backward, which takes CHOLMOD less time than solving for all
 * of the loads. The modes of the whole model are timed with the ordering, which is CHOLMOD's own choice there, and not counted.
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

enum { MODES = 10, KRYLOV = 41, BATCH = 64, MOST_DOF = 12, MOST_WIDTH = 64 };

void dpotrf_(const char *, const int *, double *, const int *, int *, size_t);
void dpotri_(const char *, const int *, double *, const int *, int *, size_t);
void dsygvx_(const int *, const char *, const char *, const char *, const int *, double *, const int *, double *, const int *,
             const double *, const double *, const int *, const int *, const double *, int *, double *, double *, const int *,
             double *, const int *, int *, int *, int *, size_t, size_t, size_t);

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
static cholmod_dense *loads, *forward, *turned, *space; /* In the order of elimination. */
static Elements kinds[2];
static Array point_mass, tested, place, value, expected, expected_shares, mass_place, mass_value, whole_expected;
static int points, groups, width, count;
static double *flexibility, *point_stiffness, *roots, *both, *combined, *shapes, *sums, whole_roots[KRYLOV];

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

static void find_flexibility(void) {
    memcpy(forward->x, loads->x, loads->nzmax * sizeof(double));
    cholmod_super_lsolve(factor, forward, space, &common);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, points, count, 1.0, forward->x, count, 0.0, flexibility, points);
}

static void condense(void) {
    int info[2];
    memcpy(point_stiffness, flexibility, sizeof(double) * points * points);
    dpotrf_("L", &points, point_stiffness, &points, &info[0], 1);
    dpotri_("L", &points, point_stiffness, &points, &info[1], 1);
    if (info[0] || info[1])
        fail("the flexibility is not definite");
}

static void find_modes(void) {
    int found, info, one = 1, modes = MODES, length = 40 * points;
    double zero = 0.0, *a = memory(points * points, 8), *b = memory(points * points, 8), *work = memory(length, 8);
    memcpy(a, point_stiffness, sizeof(double) * points * points);
    memcpy(b, point_mass.number, sizeof(double) * points * points);
    int *more = memory(6 * points, sizeof *more);
    dsygvx_(&one, "V", "I", "L", &points, a, &points, b, &points, &zero, &zero, &one, &modes, &zero, &found, roots, both, &points,
            work, &length, more, more + 5 * points, &info, 1, 1, 1);
    if (info || found != MODES)
        fail("LAPACK finds no modes");
    free(a), free(b), free(work), free(more);
}

/* Deflections of the structure in the modes and the test shapes, a row for every degree of freedom and one of zeros. */
static void find_shapes(void) {
    cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, points, width, 1.0, point_stiffness, points, both, points, 0.0, combined,
                points);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, count, width, points, 1.0, forward->x, count, combined, points, 0.0,
                turned->x, count);
    cholmod_super_ltsolve(factor, turned, space, &common);
    for (int place = 0; place < count; place++)
        for (int shape = 0; shape < width; shape++)
            shapes[((int *)factor->Perm)[place] * (int64_t)width + shape] = ((double *)turned->x)[place + (size_t)count * shape];
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

static void find_whole_modes(void) {
    int ido = 0, info = 0, parameters[11] = {1, 0, 100000, 1, 0, 0, 3}, places[11], length = KRYLOV * (KRYLOV + 8);
    int whole = whole_expected.shape[0], chosen[KRYLOV] = {0};
    double *start = memory(count, 8), *basis = memory((size_t)count * KRYLOV, 8), *work = memory(3 * (size_t)count, 8);
    double *small = memory(length, 8), one[2] = {1.0, 0.0}, zero[2] = {0.0, 0.0};
    cholmod_dense in = {count, 1, count, count, NULL, NULL, CHOLMOD_REAL, CHOLMOD_DOUBLE}, out = in;
    cholmod_dense *solved = NULL, *one_space = NULL, *other_space = NULL;
    cholmod_factor *own = cholmod_analyze(stiffness, &common);
    cholmod_factorize(stiffness, own, &common);
    do {
        dsaupd_c(&ido, "G", count, "LM", whole, DBL_EPSILON, start, KRYLOV, basis, count, parameters, places, work, small, length, &info);
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
        dseupd_c(1, "A", chosen, whole_roots, basis, count, 0.0, "G", count, "LM", whole, DBL_EPSILON, start, KRYLOV, basis, count,
                 parameters, places, work, small, length, &info);
    if (info)
        fail("ARPACK finds no modes");
    cholmod_free_factor(&own, &common);
    cholmod_free_dense(&solved, &common), cholmod_free_dense(&one_space, &common), cholmod_free_dense(&other_space, &common);
    free(start), free(basis), free(work), free(small);
}

static void read_problem(const char *folder) {
    point_mass = read_array(folder, "mass"), tested = read_array(folder, "test_shapes");
    place = read_array(folder, "t_place"), value = read_array(folder, "t_value");
    expected = read_array(folder, "frequencies"), expected_shares = read_array(folder, "shares");
    mass_place = read_array(folder, "mass_place"), mass_value = read_array(folder, "mass_value");
    whole_expected = read_array(folder, "whole_frequencies");
    groups = expected_shares.shape[0], points = point_mass.shape[0], width = MODES + tested.shape[1];
    kinds[0] = read_elements(folder, "rod", groups), kinds[1] = read_elements(folder, "panel", groups);
    for (Elements *of = kinds; of < kinds + 2; of++)
        for (int64_t at = 0; at < of->count * of->size; at++)
            count = of->dof[at] >= count ? of->dof[at] + 1 : count;
    if (width > MOST_WIDTH || whole_expected.shape[0] > KRYLOV / 2)
        fail("too many shapes");
}

/* The loads in the order of elimination, and space for everything that is timed. */
static void prepare(void) {
    int *turns = memory(count, sizeof *turns), shapes_tested = width - MODES;
    for (int turn = 0; turn < count; turn++)
        turns[((int *)factor->Perm)[turn]] = turn;
    loads = cholmod_zeros(count, points, CHOLMOD_REAL, &common);
    for (int64_t at = 0; at < value.shape[0]; at++)
        ((double *)loads->x)[turns[place.integer[2 * at]] + count * place.integer[2 * at + 1]] = value.number[at];
    free(turns);
    forward = cholmod_zeros(count, points, CHOLMOD_REAL, &common);
    turned = cholmod_zeros(count, width, CHOLMOD_REAL, &common);
    space = cholmod_zeros(factor->maxesize, points, CHOLMOD_REAL, &common);
    flexibility = memory(points * points, 8), point_stiffness = memory(points * points, 8), roots = memory(points, 8);
    both = memory(points * width, 8), combined = memory(points * width, 8);
    shapes = memory((count + 1) * (size_t)width, 8), sums = memory(groups * width * width, 8);
    for (int at = 0; at < points * shapes_tested; at++)
        both[points * MODES + at / shapes_tested + at % shapes_tested * points] = tested.number[at];
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
    for (int mode = 0; mode < MODES; mode++) {
        most = fmax(most, fabs(sqrt(roots[mode]) / (2.0 * M_PI * expected.number[mode]) - 1.0));
        for (int group = 0; group < groups; group++) {
            double share = expected_shares.number[group * expected_shares.shape[1] + mode];
            most = fmax(most, fabs(sums[(group * width + mode) * width + mode] - share) / roots[mode]);
        }
    }
    for (int mode = 0; mode < whole_expected.shape[0]; mode++)
        most = fmax(most, fabs(sqrt(whole_roots[mode]) / (2.0 * M_PI * whole_expected.number[mode]) - 1.0));
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
    double factorization = least(factorize), solution = least(find_flexibility);
    double analysis = factorization + solution + least(condense) + least(find_modes) + least(find_shapes) + least(find_shares);
    double held = most_memory(), vibration = least(find_whole_modes), difference = apart();
    fprintf(stderr, "CHOLMOD, %d DOF: frequencies and shares agree to %.1e\n", count, difference);
    if (!(difference < 1e-8))
        fail("frequencies or shares are not the same");
    print("assembly and factorization by CHOLMOD", "ms", 1e3 * factorization);
    print("flexibility by CHOLMOD", "ms", 1e3 * solution);
    print("analysis by CHOLMOD", "ms", 1e3 * analysis);
    print("20 modes by CHOLMOD (not counted)", "ms", 1e3 * vibration);
    print("most memory of the CHOLMOD process", "MB", held);
    print("entries of the factor by METIS through CHOLMOD", "million", stored[1]);
    print("entries of the factor by AMD through CHOLMOD", "million", stored[0]);
}
