/* Where tables are written: links are followed, modes kept, devices and pipes written through,
 * folders refused. On a full disk nothing is left and the old file is unchanged.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700
#define _DEFAULT_SOURCE

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <restitute/table_files.h>

#include "../support/bytes.h"
#include "../support/table.h"

static char folder[] = "test_table_files_places.XXXXXX";
static restitute_table *table;
static unsigned char *bytes; /* of a plain file */
static size_t size;

static size_t read_file(const char *path, unsigned char **content)
{
    enum { most = 1 << 20 };
    *content = malloc(most);
    return read_bytes(path, *content, most);
}

static int holds_table(const char *path)
{
    unsigned char *content;
    const size_t count = read_file(path, &content);
    const int same = count == size && memcmp(content, bytes, size) == 0;
    free(content);
    return same;
}

static void put_old(const char *path, mode_t mode)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("old", file);
    fclose(file);
    assert_int_equal(chmod(path, mode), 0);
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(lstat(path, &status), 0);
    return status.st_mode;
}

static int entries(void)
{
    int count = 0;
    DIR *here = opendir(".");
    assert_non_null(here);
    while (readdir(here))
        count++;
    closedir(here);
    return count - 2;
}

static void write_to(const char *path)
{
    restitute_error error;
    CHECK(restitute_table_write(table, path, &error) == RESTITUTE_OK, "%s", error.message);
}

static void refused(const char *path, const char *text)
{
    restitute_error error;
    CHECK(restitute_table_write(table, path, &error) == RESTITUTE_ERROR_FILE, "%s is taken", path);
    CHECK(strstr(error.message, text), "\"%s\" does not say \"%s\"", error.message, text);
}

static int set_up(void **state)
{
    restitute_material *material;
    restitute_table_options options;
    (void)state;
    restitute_scene scene = ball_on(1, &material);
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    umask(022);
    restitute_table_options_init(&options);
    options.speed[0] = options.speed[1] = 1;
    options.tolerance = 1e-2;
    assert_int_equal(restitute_table_build(&scene, &options, &table, NULL), RESTITUTE_OK);
    restitute_material_destroy(material);
    write_to("plain.h5");
    size = read_file("plain.h5", &bytes);
    assert_int_equal(unlink("plain.h5"), 0);
    return 0;
}

static int tear_down(void **state)
{
    char command[64];
    (void)state;
    restitute_table_destroy(table);
    free(bytes);
    if (chdir("..") != 0) return 1;
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static int empty_folder(void **state)
{
    (void)state;
    return system("rm -rf ./*");
}

static void links_are_followed_and_stay(void **state)
{
    (void)state;
    assert_int_equal(mkdir("there", 0777), 0);
    put_old("there/target.h5", 0644);
    assert_int_equal(symlink("there/target.h5", "link.h5"), 0);
    assert_int_equal(symlink("link.h5", "twice.h5"), 0);
    assert_int_equal(symlink("there/new.h5", "dangling.h5"), 0);
    assert_int_equal(symlink("round.h5", "round.h5"), 0);
    write_to("twice.h5");
    write_to("dangling.h5");
    assert_true(S_ISLNK(mode_of("link.h5")) && S_ISLNK(mode_of("twice.h5")) && S_ISLNK(mode_of("dangling.h5")));
    assert_true(holds_table("there/target.h5") && holds_table("there/new.h5"));
    refused("round.h5", strerror(ELOOP));
    assert_int_equal(entries(), 5);
}

static void modes_are_kept(void **state)
{
    static const mode_t modes[] = {0600, 0640, 0664, 0604, 0755}, masks[] = {0, 022, 027, 077};
    (void)state;
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        put_old("old.h5", modes[i]);
        write_to("old.h5");
        CHECK(mode_of("old.h5") == (S_IFREG | modes[i]), "%o became %o", modes[i], mode_of("old.h5"));
        assert_true(holds_table("old.h5"));
        unlink("old.h5");
    }
    for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) {
        umask(masks[i]);
        write_to("new.h5");
        CHECK(mode_of("new.h5") == (S_IFREG | (0666 & ~masks[i])), "umask %o gives %o", masks[i], mode_of("new.h5"));
        unlink("new.h5");
    }
    umask(022);
    if (geteuid() == 0) { /* may give files away */
        put_old("old.h5", 0640);
        assert_int_equal(chown("old.h5", 1, 2), 0);
        write_to("old.h5");
        struct stat status;
        assert_int_equal(stat("old.h5", &status), 0);
        CHECK(status.st_uid == 1 && status.st_gid == 2, "owner %d:%d", (int)status.st_uid, (int)status.st_gid);
    } else { /* is not written against its mode */
        put_old("closed.h5", 0444);
        refused("closed.h5", strerror(EACCES));
    }
}

/* A device of our own, so that a failure does not damage one of the machine. */
static void devices_are_written_through(void **state)
{
    (void)state;
    const char *null = "null", *full = "full";
    int usable = 0;
    if (geteuid() != 0) {
        null = "/dev/null", full = "/dev/full";
        usable = access(full, W_OK) == 0;
    } else if (mknod(null, S_IFCHR | 0666, makedev(1, 3)) == 0 && mknod(full, S_IFCHR | 0666, makedev(1, 7)) == 0) {
        const int file = open(null, O_WRONLY);
        usable = file >= 0;
        if (usable) close(file);
    }
    if (!usable) {
        print_message("skipped: no device can be made or written here\n");
        skip();
    }
    write_to(null);
    assert_true(S_ISCHR(mode_of(null)));
    refused(full, strerror(ENOSPC));
    assert_true(S_ISCHR(mode_of(full)));
    assert_int_equal(symlink(null, "link.h5"), 0);
    write_to("link.h5");
    assert_true(S_ISLNK(mode_of("link.h5")) && S_ISCHR(mode_of(null)));
}

static void pipes_are_written_through(void **state)
{
    (void)state;
    unsigned char *got = malloc(2 * size);
    assert_int_equal(mkfifo("pipe.h5", 0666), 0);
    const int file = open("pipe.h5", O_RDWR | O_NONBLOCK); /* so that a writer need not wait for a reader */
    assert_true(file >= 0);
    assert_true(size < 65536); /* what a pipe holds */
    write_to("pipe.h5");
    assert_true(S_ISFIFO(mode_of("pipe.h5")));
    assert_int_equal(read(file, got, 2 * size), size);
    assert_memory_equal(got, bytes, size);
    close(file);
    free(got);
    assert_int_equal(entries(), 1);
}

/* /dev/stdout is a link in /proc to an open file; output continues at its position. */
static void open_files_are_written_through(void **state)
{
    char name[64];
    (void)state;
    const int file = open("open.h5", O_RDWR | O_CREAT, 0666);
    assert_int_equal(write(file, "head", 4), 4);
    snprintf(name, sizeof name, "/proc/self/fd/%d", file);
    if (access(name, F_OK) != 0) {
        print_message("skipped: no /proc/self/fd here\n");
        skip();
    }
    assert_int_equal(symlink(name, "stdout"), 0);
    struct stat before, after;
    assert_int_equal(fstat(file, &before), 0);
    write_to("stdout");
    assert_int_equal(stat("open.h5", &after), 0);
    assert_true(S_ISLNK(mode_of("stdout")));
    CHECK(before.st_ino == after.st_ino && after.st_size == (off_t)size + 4, "%lld bytes", (long long)after.st_size);
    close(file);
    refused("stdout", strerror(ENOENT));
    const int closed = open("open.h5", O_RDONLY);
    assert_int_equal(closed, file); /* the lowest that is free */
    refused("stdout", strerror(EBADF));
    close(closed);
    assert_int_equal(entries(), 2);
}

static void what_cannot_be_written_is_refused(void **state)
{
    (void)state;
    assert_int_equal(mkdir("folder", 0777), 0);
    assert_int_equal(symlink("folder", "link"), 0);
    refused("folder", strerror(EISDIR));
    refused("link", strerror(EISDIR));
    refused("missing/t.h5", strerror(ENOENT));
    refused("", strerror(ENOENT));
    assert_int_equal(entries(), 2);
}

/* A limit on the size of files stands for a full disk. HDF5 must survive it, here and when the
 * program ends. */
static void without_room_nothing_changes(void **state)
{
    struct rlimit all, little;
    restitute_error error;
    (void)state;
    put_old("old.h5", 0600);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &all), 0);
    const rlim_t limits[] = {0, 100, 600, size - 1};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        little = all;
        little.rlim_cur = limits[i];
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);
        const int old = restitute_table_write(table, "old.h5", &error);
        const int new = restitute_table_write(table, "new.h5", NULL);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &all), 0);
        assert_true(old == RESTITUTE_ERROR_FILE && new == RESTITUTE_ERROR_FILE);
        CHECK(strstr(error.message, strerror(EFBIG)), "%s", error.message);
        unsigned char *content;
        CHECK(read_file("old.h5", &content) == 3 && memcmp(content, "old", 3) == 0, "the old file is lost");
        free(content);
        assert_int_equal(entries(), 1);
    }
    write_to("old.h5");
    assert_true(holds_table("old.h5"));
}

/* What a killed process left is removed; what another one is writing is not. */
static void temporary_files_that_nobody_writes_are_removed(void **state)
{
    (void)state;
    put_old("t.h5.restitute-0.tmp", 0600);
    write_to("t.h5");
    assert_int_equal(entries(), 1);
    put_old("t.h5.restitute-0.tmp", 0644);
    const int file = open("t.h5.restitute-0.tmp", O_RDWR);
    assert_int_equal(flock(file, LOCK_EX | LOCK_NB), 0);
    write_to("t.h5");
    assert_int_equal(entries(), 2);
    assert_true(mode_of("t.h5.restitute-0.tmp") == (S_IFREG | 0644) && holds_table("t.h5"));
    close(file);
    write_to("t.h5");
    assert_int_equal(entries(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(links_are_followed_and_stay, empty_folder),
        cmocka_unit_test_teardown(modes_are_kept, empty_folder),
        cmocka_unit_test_teardown(devices_are_written_through, empty_folder),
        cmocka_unit_test_teardown(pipes_are_written_through, empty_folder),
        cmocka_unit_test_teardown(open_files_are_written_through, empty_folder),
        cmocka_unit_test_teardown(what_cannot_be_written_is_refused, empty_folder),
        cmocka_unit_test_teardown(without_room_nothing_changes, empty_folder),
        cmocka_unit_test_teardown(temporary_files_that_nobody_writes_are_removed, empty_folder)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
