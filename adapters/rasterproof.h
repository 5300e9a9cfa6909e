/* The line protocol (docs/protocol.md) for programs in C and C++: include this, write two functions, and

       int main(void) { return rasterproof_serve("mine", "batch=64", triangle, line); }

   A function that is NULL is one you have not got. The second word list says what your code promises,
   such as "grid=1 rule=none mask"; requests off a declared grid or range are refused, and so are windows
   larger than the declared one (1024x1024 if none is). Needs C99 or C++11 and POSIX. */
#ifndef RASTERPROOF_H
#define RASTERPROOF_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* -std=c99 and -std=c11 hide this function of POSIX. To define _POSIX_C_SOURCE here would come too late in a program that
   includes <stdio.h> first. C++ always has it. */
#ifndef __cplusplus
FILE *fdopen(int descriptor, const char *mode);
#endif

/* Draws one pixel; outside the window it does nothing. */
typedef void (*rasterproof_set_pixel)(int x, int y);
/* Corners in pixels, y down. */
typedef void (*rasterproof_triangle)(double x0, double y0, double x1, double y1, double x2, double y2,
                                     int width, int height, rasterproof_set_pixel set_pixel);
/* From one pixel to another, in drawing order. */
typedef void (*rasterproof_line)(int x0, int y0, int x1, int y1, int width, int height,
                                 rasterproof_set_pixel set_pixel);

/* A corner for values: position in pixels, depth, w, two attributes. */
struct rasterproof_corner { double x, y, z, w, a, b; };
/* Draws one pixel with its depth and attributes; outside the window it does nothing. */
typedef void (*rasterproof_set_values)(int x, int y, double z, double a, double b);
typedef void (*rasterproof_values)(const struct rasterproof_corner corners[3], int width, int height,
                                   rasterproof_set_values set_pixel);
/* Draws the samples of one pixel: bit s of the mask is sample s. */
typedef void (*rasterproof_set_samples)(int x, int y, int mask);
typedef void (*rasterproof_samples)(double x0, double y0, double x1, double y1, double x2, double y2,
                                    int width, int height, rasterproof_set_samples set_pixel);

/* Gives samples of one pixel the same values: bit s of the mask is sample s. */
typedef void (*rasterproof_set_sampled)(int x, int y, int mask, double z, double a, double b);
typedef void (*rasterproof_sample_values)(const struct rasterproof_corner corners[3], int width, int height,
                                          rasterproof_set_sampled set_samples);

/* A corner for depth order: position in pixels, depth. */
struct rasterproof_point { double x, y, z; };
/* Shows triangle t, counted from 0, at one pixel; outside the window it does nothing. */
typedef void (*rasterproof_set_seen)(int x, int y, int t);
/* Three corners for each triangle; set_pixel once for each pixel, of the nearest one. */
typedef void (*rasterproof_depth)(const struct rasterproof_point (*triangles)[3], int count, int width, int height,
                                  rasterproof_set_seen set_pixel);
/* A corner in clip space. */
struct rasterproof_clip_corner { double x, y, z, w; };
/* Appends a corner to the polygon. */
typedef void (*rasterproof_add_corner)(double x, double y, double z, double w);
/* Adds the corners of what z >= -w leaves of a triangle. */
typedef void (*rasterproof_clip)(const struct rasterproof_clip_corner corners[3], rasterproof_add_corner add_corner);

/* The same with an attribute, which new corners get as well. */
struct rasterproof_carried_corner { double x, y, z, w, a; };
typedef void (*rasterproof_add_carried)(double x, double y, double z, double w, double a);
typedef void (*rasterproof_clip_attributes)(const struct rasterproof_carried_corner corners[3],
                                            rasterproof_add_carried add_corner);

/* Draws every pixel of a line with a width, from one position to another, all in pixels. */
typedef void (*rasterproof_wide_line)(double x0, double y0, double x1, double y1, double line_width,
                                      int width, int height, rasterproof_set_pixel set_pixel);

/* What a formula of the pipeline gives: its numbers, 16 at most, go to `answer`. Returns how many there are. */
typedef int (*rasterproof_formula)(const char *name, const double *numbers, int count, double *answer);

/* What the program draws; what is NULL it has not got. */
struct rasterproof_drawers {
    rasterproof_triangle triangle;
    rasterproof_line line;
    rasterproof_values values;
    rasterproof_samples samples;
    rasterproof_depth depth;
    rasterproof_clip clip;
    rasterproof_clip_attributes clip_attributes;
    rasterproof_wide_line wide_line;
    /* The share of each pixel that is covered: the mask is a level, and 255 a pixel that is covered whole. */
    rasterproof_samples area;
    rasterproof_sample_values sample_values;
    rasterproof_formula formula;
};

enum { RASTERPROOF_MOST_BYTES = 65536, RASTERPROOF_MOST_HITS = 1 << 22,
       RASTERPROOF_MOST_TRIANGLES = 64, RASTERPROOF_MOST_WORDS = 5 + 9 * RASTERPROOF_MOST_TRIANGLES };

struct rasterproof_hit { int y, x, mask; double z, a, b; };

/* What set_pixel has drawn for the request in hand. */
static struct {
    struct rasterproof_hit *hits;
    int count, room, width, height, overflow;
} rasterproof_plane;

static void rasterproof_hit_values(int x, int y, double z, double a, double b) {
    struct rasterproof_hit *hit;
    if (x < 0 || y < 0 || x >= rasterproof_plane.width || y >= rasterproof_plane.height) return;
    if (rasterproof_plane.count == RASTERPROOF_MOST_HITS) { rasterproof_plane.overflow = 1; return; }
    if (rasterproof_plane.count == rasterproof_plane.room) {
        rasterproof_plane.room = rasterproof_plane.room ? 2 * rasterproof_plane.room : 4096;
        rasterproof_plane.hits = (struct rasterproof_hit *)realloc(
            rasterproof_plane.hits, (size_t)rasterproof_plane.room * sizeof *rasterproof_plane.hits);
        if (!rasterproof_plane.hits) { fputs("out of memory\n", stderr); exit(1); }
    }
    hit = &rasterproof_plane.hits[rasterproof_plane.count++];
    hit->y = y, hit->x = x, hit->mask = 0, hit->z = z, hit->a = a, hit->b = b;
}

static void rasterproof_hit_pixel(int x, int y) { rasterproof_hit_values(x, y, 0, 0, 0); }

static void rasterproof_hit_samples(int x, int y, int mask) {
    int before = rasterproof_plane.count;
    if (mask) rasterproof_hit_values(x, y, 0, 0, 0);
    if (rasterproof_plane.count > before) rasterproof_plane.hits[before].mask = mask;
}

static void rasterproof_hit_sampled(int x, int y, int mask, double z, double a, double b) {
    int before = rasterproof_plane.count;
    rasterproof_hit_values(x, y, z, a, b);
    if (rasterproof_plane.count > before) rasterproof_plane.hits[before].mask = mask;
}

static void rasterproof_hit_seen(int x, int y, int t) {
    int before = rasterproof_plane.count;
    rasterproof_hit_values(x, y, 0, 0, 0);
    if (rasterproof_plane.count > before) rasterproof_plane.hits[before].mask = t;
}

/* The corners that add_corner has added; those beyond the last place are counted alone. */
static struct { struct rasterproof_carried_corner corners[64]; int count; } rasterproof_polygon;

static void rasterproof_carry(double x, double y, double z, double w, double a) {
    const struct rasterproof_carried_corner corner = {x, y, z, w, a};
    if (rasterproof_polygon.count < 64) rasterproof_polygon.corners[rasterproof_polygon.count] = corner;
    if (rasterproof_polygon.count <= 64) rasterproof_polygon.count++;
}

static void rasterproof_add(double x, double y, double z, double w) { rasterproof_carry(x, y, z, w, 0); }

static int rasterproof_by_row(const void *left, const void *right) {
    const struct rasterproof_hit *a = (const struct rasterproof_hit *)left;
    const struct rasterproof_hit *b = (const struct rasterproof_hit *)right;
    return a->y != b->y ? (a->y > b->y) - (a->y < b->y) : (a->x > b->x) - (a->x < b->x);
}

/* One past the run that starts at hit i: neighbours in a row. A pixel hit twice is in two runs. */
static int rasterproof_run_end(int i) {
    const struct rasterproof_hit *hit = rasterproof_plane.hits;
    int end = i + 1;
    while (end < rasterproof_plane.count && hit[end].y == hit[i].y && hit[end].x == hit[end - 1].x + 1) end++;
    return end;
}

static void rasterproof_write_runs(FILE *out, const char *id) {
    const struct rasterproof_hit *hit = rasterproof_plane.hits;
    int i, runs = 0, sorted = 1, count = rasterproof_plane.count;
    for (i = 1; i < count && sorted; i++) sorted = rasterproof_by_row(&hit[i - 1], &hit[i]) <= 0;
    if (!sorted) qsort(rasterproof_plane.hits, (size_t)count, sizeof *hit, rasterproof_by_row);
    for (i = 0; i < count; i = rasterproof_run_end(i)) runs++;
    fprintf(out, "C %s %d", id, runs);
    for (i = 0; i < count; i = rasterproof_run_end(i))
        fprintf(out, " %d %d %d", hit[i].y, hit[i].x, hit[rasterproof_run_end(i) - 1].x + 1);
}

static void rasterproof_write_line(FILE *out, const char *id) {
    int i;
    fprintf(out, "P %s %d", id, rasterproof_plane.count);
    for (i = 0; i < rasterproof_plane.count; i++)
        fprintf(out, " %d %d", rasterproof_plane.hits[i].x, rasterproof_plane.hits[i].y);
}

/* Pixels with their values, or samples with theirs. */
static void rasterproof_write_values(FILE *out, char letter, const char *id) {
    int i;
    fprintf(out, "%c %s %d", letter, id, rasterproof_plane.count);
    for (i = 0; i < rasterproof_plane.count; i++) {
        const struct rasterproof_hit *hit = &rasterproof_plane.hits[i];
        fprintf(out, " %d %d", hit->x, hit->y);
        if (letter == 'U') fprintf(out, " %d", hit->mask);
        fprintf(out, " %.17g %.17g %.17g", hit->z, hit->a, hit->b);
    }
}

/* Pixels with their masks, or with the triangles they show. */
static void rasterproof_write_marked(FILE *out, char letter, const char *id) {
    int i;
    fprintf(out, "%c %s %d", letter, id, rasterproof_plane.count);
    for (i = 0; i < rasterproof_plane.count; i++) {
        const struct rasterproof_hit *hit = &rasterproof_plane.hits[i];
        fprintf(out, " %d %d %d %d", hit->y, hit->x, hit->x + 1, hit->mask);
    }
}

static void rasterproof_write_polygon(FILE *out, const char *id, int carries) {
    int i;
    fprintf(out, "%c %s %d", carries ? 'B' : 'G', id, rasterproof_polygon.count);
    for (i = 0; i < rasterproof_polygon.count; i++) {
        const struct rasterproof_carried_corner *corner = &rasterproof_polygon.corners[i];
        fprintf(out, " %.17g %.17g %.17g %.17g", corner->x, corner->y, corner->z, corner->w);
        if (carries) fprintf(out, " %.17g", corner->a);
    }
}

/* The number that a declaration such as "grid=16" gives, or the fallback. */
static double rasterproof_declared(const char *declares, const char *word, double fallback) {
    const char *at = strstr(declares, word);
    return at ? strtod(at + strlen(word), NULL) : fallback;
}

/* Reads a line without its end; of a longer one the rest is thrown away. Its length, or -1 at the end. */
static int rasterproof_read(char *line) {
    int c, count = 0;
    while ((c = getc(stdin)) != EOF && c != '\n')
        if (count <= RASTERPROOF_MOST_BYTES) line[count++] = (char)(c ? c : '?');
    line[count] = '\0';
    return c == EOF && count == 0 ? -1 : count;
}

/* Reads what follows the id and draws. What is wrong with the request, or NULL. */
static const char *rasterproof_draw(char **words, int count, const char *declares,
                                    const struct rasterproof_drawers *drawers) {
    static char reason[100];
    double grid = rasterproof_declared(declares, "grid=", 0), range = rasterproof_declared(declares, "range=", 0);
    double most_wide = rasterproof_declared(declares, "window=", 1024), most_high = most_wide;
    double v[RASTERPROOF_MOST_WORDS];
    const char *high = strstr(declares, "window=");
    const char verb = words[0][0];
    /* Of each corner the first two numbers are positions. */
    const int has_values = verb == 'I' || verb == 'X', size = has_values ? 6 : verb == 'D' ? 3 : 2;
    int i, numbers = has_values ? 18 : verb == 'L' ? 4 : verb == 'W' ? 5 : 6;
    if (verb == 'D') numbers = count < 13 ? 9 : (count - 4) / 9 * 9;
    if (high && (high = strchr(high, 'x')) != NULL) most_high = strtod(high + 1, NULL);
    if (count != numbers + 4) {
        snprintf(reason, sizeof reason, "%s takes id width height and %d numbers", words[0], numbers);
        return reason;
    }
    for (i = 0; i < numbers + 2; i++) {
        char *end;
        v[i] = strtod(words[i + 2], &end);
        if (*end) v[i] = NAN;
    }
    if (!(v[0] >= 1 && v[0] <= most_wide && v[0] == floor(v[0]) && v[1] >= 1 && v[1] <= most_high &&
          v[1] == floor(v[1]))) {
        snprintf(reason, sizeof reason, "the window must be from 1x1 to %gx%g", most_wide, most_high);
        return reason;
    }
    for (i = 2; i < numbers + 2; i++) {
        if (verb == 'W' ? i == 6 : (i - 2) % size > 1) {
            if (!(fabs(v[i]) <= 1.7976931348623157e308)) return "a value is not a number";
            continue;
        }
        if (!(v[i] >= -2147483648.0 && v[i] < 2147483648.0)) return "a coordinate is not a number within 2^31 px";
        if (range && fabs(v[i]) > range) return "unsupported: out of the declared range";
        if (grid && v[i] * grid != floor(v[i] * grid)) return "unsupported: off the declared grid";
    }
    rasterproof_plane.count = rasterproof_plane.overflow = 0;
    rasterproof_plane.width = (int)v[0];
    rasterproof_plane.height = (int)v[1];
    if (verb == 'T')
        drawers->triangle(v[2], v[3], v[4], v[5], v[6], v[7], (int)v[0], (int)v[1], rasterproof_hit_pixel);
    else if (verb == 'W')
        drawers->wide_line(v[2], v[3], v[4], v[5], v[6], (int)v[0], (int)v[1], rasterproof_hit_pixel);
    else if (verb == 'S' || verb == 'R')
        (verb == 'S' ? drawers->samples : drawers->area)(v[2], v[3], v[4], v[5], v[6], v[7], (int)v[0], (int)v[1], rasterproof_hit_samples);
    else if (verb == 'D') {
        struct rasterproof_point triangles[RASTERPROOF_MOST_TRIANGLES][3];
        for (i = 0; i < numbers / 3; i++) {
            struct rasterproof_point *point = &triangles[i / 3][i % 3];
            point->x = v[2 + 3 * i], point->y = v[3 + 3 * i], point->z = v[4 + 3 * i];
        }
        drawers->depth((const struct rasterproof_point (*)[3])triangles, numbers / 9, (int)v[0], (int)v[1], rasterproof_hit_seen);
    } else if (has_values) {
        struct rasterproof_corner corners[3];
        for (i = 0; i < 3; i++) {
            const double *at = v + 2 + 6 * i;
            corners[i].x = at[0], corners[i].y = at[1], corners[i].z = at[2];
            corners[i].w = at[3], corners[i].a = at[4], corners[i].b = at[5];
        }
        if (verb == 'I') drawers->values(corners, (int)v[0], (int)v[1], rasterproof_hit_values);
        else drawers->sample_values(corners, (int)v[0], (int)v[1], rasterproof_hit_sampled);
    } else
        drawers->line((int)floor(v[2]), (int)floor(v[3]), (int)floor(v[4]), (int)floor(v[5]), (int)v[0], (int)v[1],
             rasterproof_hit_pixel);
    return rasterproof_plane.overflow ? "more than 4194304 pixels set" : NULL;
}

/* Reads what follows the id and clips: the near plane has no window. What is wrong with the request, or NULL. */
static const char *rasterproof_cut(char **words, int count, const struct rasterproof_drawers *drawers) {
    struct rasterproof_clip_corner corners[3];
    struct rasterproof_carried_corner carried[3];
    double v[15];
    const int carries = words[0][0] == 'A', size = carries ? 5 : 4;
    int i;
    if (count != 2 + 3 * size) return carries ? "A takes id and 15 numbers" : "N takes id and 12 numbers";
    for (i = 0; i < 3 * size; i++) {
        char *end;
        v[i] = strtod(words[i + 2], &end);
        if (*end || !(fabs(v[i]) <= 1.7976931348623157e308)) return "a value is not a number";
    }
    for (i = 0; i < 3; i++) {
        const double *at = v + size * i;
        corners[i].x = carried[i].x = at[0], corners[i].y = carried[i].y = at[1];
        corners[i].z = carried[i].z = at[2], corners[i].w = carried[i].w = at[3];
        carried[i].a = carries ? at[4] : 0;
    }
    rasterproof_polygon.count = 0;
    if (carries) drawers->clip_attributes(carried, rasterproof_carry);
    else drawers->clip(corners, rasterproof_add);
    return rasterproof_polygon.count > 64 ? "more than 64 corners" : NULL;
}

/* Reads the name of a formula and its numbers, and writes what it gives. What is wrong with the request, or NULL. */
static const char *rasterproof_compute(char **words, int count, FILE *out, rasterproof_formula formula) {
    double v[RASTERPROOF_MOST_WORDS], answer[16];
    int i, given;
    if (count < 3) return "Q takes id, a name and numbers";
    for (i = 3; i < count; i++) {
        char *end;
        v[i - 3] = strtod(words[i], &end);
        if (*end || !(fabs(v[i - 3]) <= 1.7976931348623157e308)) return "a value is not a number";
    }
    given = formula(words[2], v, count - 3, answer);
    fprintf(out, "O %s %d", words[1], given);
    for (i = 0; i < given; i++) fprintf(out, " %.17g", answer[i]);
    return NULL;
}

static void rasterproof_answer(char **words, int count, FILE *out, const char *name, const char *declares,
                               const struct rasterproof_drawers *drawers) {
    const char *verb = words[0], *id = count > 1 ? words[1] : "-", *wrong = "unsupported";
    int is_known = !verb[1] && ((verb[0] == 'T' && drawers->triangle) || (verb[0] == 'L' && drawers->line) ||
                                (verb[0] == 'I' && drawers->values) || (verb[0] == 'S' && drawers->samples) ||
                                (verb[0] == 'D' && drawers->depth) || (verb[0] == 'N' && drawers->clip) ||
                                (verb[0] == 'A' && drawers->clip_attributes) || (verb[0] == 'W' && drawers->wide_line) ||
                                (verb[0] == 'R' && drawers->area) || (verb[0] == 'X' && drawers->sample_values) ||
                                (verb[0] == 'Q' && drawers->formula));
    if (strcmp(verb, "HELLO") == 0) {
        char known[120] = "";
        if (drawers->triangle) strcat(known, " coverage");
        if (drawers->line) strcat(known, " line");
        if (drawers->values) strcat(known, " attributes");
        if (drawers->samples) strcat(known, " samples4");
        if (drawers->depth) strcat(known, " depth");
        if (drawers->clip) strcat(known, " clip");
        if (drawers->clip_attributes) strcat(known, " clip-attributes");
        if (drawers->wide_line) strcat(known, " wide-line");
        if (drawers->area) strcat(known, " area");
        if (drawers->sample_values) strcat(known, " sample-values");
        if (drawers->formula) strcat(known, " formulas");
        if (count == 2 && strcmp(id, "1") == 0) fprintf(out, "HELLO 1 %s%s", name, known);
        else if (count == 2 && strcmp(id, "2") == 0)
            fprintf(out, "HELLO 2 %s%s%s%s%s", name, known, strstr(declares, "window=") ? "" : " window=1024x1024",
                    *declares ? " " : "", declares);
        else fputs("E - say HELLO 1 or HELLO 2", out);
        return;
    }
    if (is_known && verb[0] == 'Q') wrong = rasterproof_compute(words, count, out, drawers->formula);
    else if (is_known && (verb[0] == 'N' || verb[0] == 'A')) wrong = rasterproof_cut(words, count, drawers);
    else if (is_known) wrong = rasterproof_draw(words, count, declares, drawers);
    if (wrong) fprintf(out, "E %s %s", id, wrong);
    else if (verb[0] == 'Q') return;
    else if (verb[0] == 'T' || verb[0] == 'W') rasterproof_write_runs(out, id);
    else if (verb[0] == 'I' || verb[0] == 'X') rasterproof_write_values(out, verb[0] == 'I' ? 'F' : 'U', id);
    else if (verb[0] == 'S') rasterproof_write_marked(out, 'M', id);
    else if (verb[0] == 'D') rasterproof_write_marked(out, 'V', id);
    else if (verb[0] == 'R') rasterproof_write_marked(out, 'K', id);
    else if (verb[0] == 'N' || verb[0] == 'A') rasterproof_write_polygon(out, id, verb[0] == 'A');
    else rasterproof_write_line(out, id);
}

/* Answers requests until the input ends. What the program itself prints goes to the error output. */
static int rasterproof_serve_all(const char *name, const char *declares, struct rasterproof_drawers drawers) {
    static char request[RASTERPROOF_MOST_BYTES + 2];
    FILE *out = fdopen(dup(1), "w");
    int length;
    if (!out || dup2(2, 1) < 0) { perror("rasterproof"); return 1; }
    while ((length = rasterproof_read(request)) >= 0) {
        char *words[RASTERPROOF_MOST_WORDS + 1], *word = strtok(request, " \t\r\v\f");
        int count = 0;
        for (; word; word = strtok(NULL, " \t\r\v\f"))
            words[count < RASTERPROOF_MOST_WORDS ? count++ : count] = word;
        if (count == 0) continue;
        if (length > RASTERPROOF_MOST_BYTES) fputs("E - a request has at most 65536 bytes", out);
        else rasterproof_answer(words, count, out, name, declares, &drawers);
        putc('\n', out);
        if (fflush(out)) return 1;
    }
    return 0;
}

/* The same for a program that draws triangles and lines alone. */
static inline int rasterproof_serve(const char *name, const char *declares, rasterproof_triangle triangle, rasterproof_line line) {
    struct rasterproof_drawers drawers = {triangle, line, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    return rasterproof_serve_all(name, declares, drawers);
}

#endif
