// SPDX-License-Identifier: MIT
// What a fault does to a PIC in gpsim.
#include <vector>

#include <gpsim/processor.h>

#include <gpsim/pic-processor.h>
#include <gpsim/sim_context.h>

#include "chip.hh"

namespace
{

constexpr unsigned goto_pic14 = 0x2800;   // and eleven bits of the address
constexpr unsigned to_itself_18 = 0xD7FF; // bra $

struct Hung {
    unsigned at;
    unsigned was;
};
std::vector<Hung> hung;

pic_processor &pic()
{
    return *dynamic_cast<pic_processor *>(
        CSimulationContext::GetContext()->GetActiveCPU());
}

void mend()
{
    for (const Hung &one : hung) {
        pic().pma->put_opcode(one.at, one.was);
    }
    hung.clear();
}

} // namespace

void Chip::reset()
{
    mend();
    pic().reset(POR_RESET);
}

void Chip::hang()
{
    const unsigned at = program_counter();

    mend();
    hung.push_back({at, pic().pma->get_opcode(at)});
    pic().pma->put_opcode(at, is_pic18() ? to_itself_18
                                         : goto_pic14 | (at & 0x7FFu));
}
