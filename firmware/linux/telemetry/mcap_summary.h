// Writes the summary at the end of an MCAP file, the index of viewers. Not real time; no heap.
#pragma once

#include "firmware/linux/telemetry/file_sink.h"

namespace tactus::firmware {

// Ends the data section of a file whose last record is complete. Then adds copies of its schemas
// and channels, the indexes of chunks, attachments and metadata, statistics, offsets and footer. It
// collects them by reading the file, so that a long run needs no more memory than a short one. The
// sink holds errors. A file that cannot be read back gets no summary.
void write_mcap_summary(FileSink& sink);

}  // namespace tactus::firmware
