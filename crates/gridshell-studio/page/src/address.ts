/** Take the token out of the address, once the cookie that came with the page does as well. */
export async function clean(): Promise<void> {
  if (location.pathname === "/") return;
  const answer = await fetch("/").catch(() => null);
  if (answer?.ok) history.replaceState(null, "", "/");
}
