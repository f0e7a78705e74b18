#pragma once

namespace railwave::hdf5 {

/// HDF5 may go round in circles in a damaged file. From now on a call of the readers may take so many seconds of
/// processor time; one that takes longer ends the process by SIGPROF. For processes that do nothing but read.
/// @param seconds 0: no limit, as at the start
void limit_calls(double seconds);

/// A call of HDF5, from making this to its end.
class LimitedCall {
 public:
  LimitedCall();
  ~LimitedCall();
  LimitedCall(const LimitedCall&) = delete;
  LimitedCall& operator=(const LimitedCall&) = delete;
};

}  // namespace railwave::hdf5
