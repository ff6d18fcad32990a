/* A rover collects rocks on a strip of land and must not run out of battery.

   cc -O2 -o rover rover.c
   grammarbt run --domain exec --set domain.command=./rover

   Nothing but the C library is needed: a request has its numbers in front, and the tree comes as a table. */

#define _POSIX_C_SOURCE 200809L
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FAILURE, SUCCESS, RUNNING };  /* what a leaf answers */
enum { LEAF, OCCURRENCE, ON_SUCCESS, ON_FAILURE, ON_RUNNING, COLUMNS };  /* of the table */
enum { DRIVE_HOME, CHARGE, BATTERY_LOW, AT_BASE, DRIVE_TO_ROCK, COLLECT, AT_ROCK };  /* leaves as announced */
enum { CELLS = 12, ROCKS = 8, STEPS = 140, FULL = 30, LOW = 14, SCENARIOS = 10000, NUMBERS = 100000 };

static const char *ANNOUNCEMENT =
    "{\"protocol\":1,\"episodes\":true,\"grammar\":\"scheide\",\"groups\":["
    "{\"name\":\"energy\",\"actions\":[\"drive home\",\"charge\"],"
    "\"conditions\":[{\"name\":\"battery low\",\"pure\":true},{\"name\":\"at base\",\"pure\":true}]},"
    "{\"name\":\"science\",\"actions\":[\"drive to rock\",\"collect\"],"
    "\"conditions\":[{\"name\":\"at rock\",\"pure\":true}]}],"
    "\"references\":[{\"name\":\"manual\",\"tree\":"
    "\"?( →( ?( !(at base) [charge] ) (battery low) [drive home] ) →( [drive to rock] [collect] ) )\"}]}";

typedef struct {
  uint64_t random;
  int place, battery, collected, rock[CELLS];
} World;

static double uniform(World *world) {  /* SplitMix64 (Steele, Lea & Flood, OOPSLA 2014) */
  uint64_t z = (world->random += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static World fresh(int64_t scenario) {  /* the same world for every tree */
  World world = {.random = (uint64_t)scenario, .battery = FULL};
  for (int i = 0; i < ROCKS; i++) world.rock[1 + (int)(uniform(&world) * (CELLS - 1))] = 1;
  return world;
}

static int nearest_rock(const World *world) {
  for (int far = 0; far < CELLS; far++)
    for (int side = -1; side <= 1; side += 2) {
      int cell = world->place + side * far;
      if (cell >= 0 && cell < CELLS && world->rock[cell]) return cell;
    }
  return -1;
}

static int drive(World *world, int goal) {
  if (goal < 0) return FAILURE;
  if (world->place == goal) return SUCCESS;
  world->place += goal > world->place ? 1 : -1;
  world->battery--;
  return RUNNING;
}

static int charge(World *world) {
  if (world->place != 0) return FAILURE;
  world->battery = world->battery + 6 < FULL ? world->battery + 6 : FULL;
  return world->battery == FULL ? SUCCESS : RUNNING;
}

static int collect(World *world) {
  if (!world->rock[world->place]) return FAILURE;
  world->battery -= 2;
  if (uniform(world) < .4) return RUNNING;
  world->rock[world->place] = 0;
  world->collected++;
  return SUCCESS;
}

static int answer(World *world, int leaf) {
  switch (leaf) {
    case DRIVE_HOME: return drive(world, 0);
    case CHARGE: return charge(world);
    case BATTERY_LOW: return world->battery < LOW;
    case AT_BASE: return world->place == 0;
    case DRIVE_TO_ROCK: return drive(world, nearest_rock(world));
    case COLLECT: return collect(world);
    default: return world->rock[world->place];
  }
}

static void draw(const World *world) {  /* the marks: the base, the rocks that are left, the rover and its battery */
  printf("[{\"name\":\"base\",\"shape\":\"square\",\"role\":\"place\",\"x\":0,\"y\":0,\"size\":0.9}");
  for (int i = 0; i < CELLS; i++)
    printf(",{\"name\":\"rock %d\",\"shape\":\"circle\",\"role\":\"object\",\"x\":%d,\"y\":0,\"size\":0.8,\"shade\":%d}",
           i, i, world->rock[i]);
  printf(",{\"name\":\"rover\",\"shape\":\"triangle\",\"role\":\"robot\",\"x\":%d,\"y\":0,\"size\":0.6,\"label\":\"%d\"}]",
         world->place, world->battery);
}

static double reward(const World *world) {
  return 10.0 * world->collected - (world->battery > 0 ? 0.0 : 30.0);
}

static int64_t ticks[NUMBERS];  /* of each leaf of the tree */

static void tick(World *world, const int64_t *table, int shown) {
  static const char *STATUS[] = {"failure", "success", "running"};
  for (int64_t at = 0; at >= 0;) {  /* a negative number ends it */
    const int64_t *row = table + at * COLUMNS;
    int status = answer(world, (int)row[LEAF]);
    ticks[row[OCCURRENCE]]++;
    if (shown) printf("%s[%d,\"%s\"]", at ? "," : "", (int)row[OCCURRENCE], STATUS[status]);
    at = row[status == SUCCESS ? ON_SUCCESS : status == FAILURE ? ON_FAILURE : ON_RUNNING];
  }
}

static double episode(const int64_t *table, int64_t scenario) {
  World world = fresh(scenario);
  for (int step = 0; step < STEPS && world.battery > 0; step++) tick(&world, table, 0);
  return reward(&world);
}

static void show(const int64_t *table, int64_t scenario) {  /* the same, told tick by tick */
  World world = fresh(scenario);
  printf("\"unit\":\"points\",\"box\":[-1,-2,%d,2],\"marks\":", CELLS);
  draw(&world);
  printf(",\"frames\":[");
  for (int step = 0; step < STEPS && world.battery > 0; step++) {
    printf("%s{\"answers\":[", step ? "," : "");
    tick(&world, table, 1);
    printf("],\"reward\":%.17g,\"changes\":", reward(&world));
    draw(&world);
    printf("}");
  }
  printf("]}\n");
}

static int numbers_after(const char *line, const char *key, int64_t *numbers, int most) {
  const char *at = strstr(line, key);  /* quotes inside texts have a backslash, so this finds the key alone */
  int count = 0;
  for (at = at ? at + strlen(key) : "]"; *at != ']' && count < most; at += *at == ',')
    numbers[count++] = strtoll(at, (char **)&at, 10);
  return count;
}

static int leaves_in(const char *line) {  /* no name of ours has quotes in it, so this stands between leaves alone */
  int count = 1;
  for (const char *at = strstr(line, "\"leaves\":["); *at != '\n' && strncmp(at, "],\"tree\":", 9); at++)
    count += strncmp(at, "\",\"", 3) == 0;
  return count;
}

int main(void) {
  static int64_t scenarios[SCENARIOS], table[NUMBERS];
  char *line = NULL;
  size_t size = 0;
  setvbuf(stdout, NULL, _IOLBF, 0);  /* every line goes out at once */
  puts(ANNOUNCEMENT);
  while (getline(&line, &size, stdin) > 0) {
    const char *shown = strstr(line, "\"episode\":");
    int count = numbers_after(line, "\"scenarios\":[", scenarios, SCENARIOS), leaves = leaves_in(line);
    numbers_after(line, "\"policy\":[", table, NUMBERS);
    memset(ticks, 0, (size_t)leaves * sizeof *ticks);
    printf("{\"id\":%lld,", atoll(line + strlen("{\"id\":")));
    if (shown) {
      show(table, atoll(shown + strlen("\"episode\":")));
      continue;
    }
    printf("\"returns\":[");
    for (int i = 0; i < count; i++) printf("%s%.17g", i ? "," : "", episode(table, scenarios[i]));
    printf("],\"ticks\":[");
    for (int i = 0; i < leaves; i++) printf("%s%lld", i ? "," : "", (long long)ticks[i]);
    puts("]}");
  }
  free(line);
  return 0;
}
