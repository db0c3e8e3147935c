/* Plugin of qemu-user: instructions that the emulated program executed from one function semtrack_count_NAME to the
 * next. A row "NAME instructions since the one before" goes to the plugin log (-d plugin -D FILE).
 * A program without such functions (a bare board's image, under qemu-system) gives one row "all" at its end.
 * Debian packages no qemu-plugin.h: the calls used, of plugin API 1 (QEMU 7.2), are declared here. */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
typedef void (*translated_cb)(qemu_plugin_id_t id, struct qemu_plugin_tb* tb);
typedef void (*executed_cb)(unsigned int vcpu, void* data);
typedef void (*exit_cb)(qemu_plugin_id_t id, void* data);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* tb);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* tb, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* insn);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, translated_cb cb);
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* tb, enum qemu_plugin_op op, void* counter,
                                              uint64_t by);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb* tb, executed_cb cb, enum qemu_plugin_cb_flags flags,
                                          void* data);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, exit_cb cb, void* data);
void qemu_plugin_outs(const char* text);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

static const char kPrefix[] = "semtrack_count_";
static uint64_t executed;
static uint64_t before;

static void marked(unsigned int vcpu, void* name) {
    char row[128];
    (void)vcpu;
    (void)snprintf(row, sizeof row, "%s %" PRIu64 "\n", (const char*)name, executed - before);
    before = executed;
    qemu_plugin_outs(row);
}

/* A marker is called, so its first instruction begins a block, and the symbol stays in the program's table. */
static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* tb) {
    const char* const symbol = qemu_plugin_insn_symbol(qemu_plugin_tb_get_insn(tb, 0));
    (void)id;
    qemu_plugin_register_vcpu_tb_exec_inline(tb, QEMU_PLUGIN_INLINE_ADD_U64, &executed, qemu_plugin_tb_n_insns(tb));
    if (symbol != NULL && strncmp(symbol, kPrefix, sizeof kPrefix - 1) == 0) {
        qemu_plugin_register_vcpu_tb_exec_cb(tb, marked, QEMU_PLUGIN_CB_NO_REGS,
                                             (void*)(symbol + sizeof kPrefix - 1));
    }
}

static void at_exit(qemu_plugin_id_t id, void* data) {
    (void)id;
    (void)data;
    if (before == 0) {
        marked(0, (void*)"all");
    }
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int argc,
                                                               char** argv) {
    (void)info;
    (void)argc;
    (void)argv;
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, at_exit, NULL);
    return 0;
}
