/* The part of QEMU's interface for TCG plugins (version 1) that count.c needs; QEMU documents it in
 * docs/devel/tcg-plugins, and Debian has no package of its header. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint64_t qemu_plugin_id_t;
typedef uint32_t qemu_plugin_meminfo_t;

struct qemu_info_t {
    const char* target_name;
    struct {
        int minimum;
        int current;
    } version;
    bool system_emulation;
    struct {
        int smp;
        int max;
    } vcpus;
};

struct qemu_plugin_tb;   /* a translated block: entered at its start, left at its end */
struct qemu_plugin_insn; /* an instruction of it */

enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_mem_rw { QEMU_PLUGIN_MEM_R = 1, QEMU_PLUGIN_MEM_W, QEMU_PLUGIN_MEM_RW };

typedef void (*qemu_plugin_translated)(qemu_plugin_id_t, struct qemu_plugin_tb*);
typedef void (*qemu_plugin_executed)(unsigned cpu, void* data);
typedef void (*qemu_plugin_accessed)(unsigned cpu, qemu_plugin_meminfo_t, uint64_t address,
                                     void* data);
typedef void (*qemu_plugin_ended)(qemu_plugin_id_t, void* data);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, qemu_plugin_translated);
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb*, enum qemu_plugin_op,
                                              void* counter, uint64_t amount);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, qemu_plugin_executed,
                                            enum qemu_plugin_cb_flags, void* data);
void qemu_plugin_register_vcpu_mem_cb(struct qemu_plugin_insn*, qemu_plugin_accessed,
                                      enum qemu_plugin_cb_flags, enum qemu_plugin_mem_rw,
                                      void* data);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, qemu_plugin_ended, void* data);

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t index);
char* qemu_plugin_insn_disas(const struct qemu_plugin_insn*); /* the caller frees it */
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn*);
unsigned qemu_plugin_mem_size_shift(qemu_plugin_meminfo_t);
