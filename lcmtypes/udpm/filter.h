/* What the kernel lets through to a bus. */
#ifndef LIMPHOME_UDPM_FILTER_H
#define LIMPHOME_UDPM_FILTER_H

#include "udpm.h"

/* LCM's header in front of the channel's name: "LC02" for a message that is in this datagram as a whole, and a count.
 */
enum { UDPM_MAGIC_SIZE = 4, UDPM_HEADER_SIZE = 8 };
#define UDPM_MAGIC "LC02"

/* Has the kernel drop, before it wakes anybody, datagrams that are no message on a channel subscribed to. It is nothing
 * to rely on, as not every system has such filters: udpm_handle looks at the same things again. */
void udpm_filter(const udpm *bus);

#endif
