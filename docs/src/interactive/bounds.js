// Largest size of each error of the mount in seconds of arc; what `trueaxis bound` proves of |exact - first order|; what it found.
window.bounds = [
  [1, 2.3505e-10, 1.7382e-10],
  [3, 2.1155e-9, 1.5644e-9],
  [10, 2.3509e-8, 1.7382e-8],
  [30, 2.1165e-7, 1.5644e-7],
  [60, 8.4705e-7, 6.2577e-7],
  [180, 7.6394e-6, 5.6322e-6],
  [600, 8.5502e-5, 6.2592e-5],
  [1800, 7.8547e-4, 5.6360e-4],
  [3600, 3.2376e-3, 2.2560e-3],
];
